// GL objects: names, memory shared with the CPU, round trips of texels, draws, timestamps, limits.
#include <gtest/gtest.h>

#include <chrono>
#include <cstdint>
#include <numeric>
#include <vector>

#include "core/error.h"
#include "gl/buffer.h"
#include "gl/debug_output.h"
#include "gl/fence.h"
#include "gl/framebuffer.h"
#include "gl/program_library.h"
#include "gl/query.h"
#include "gl/texture.h"
#include "gl/vertex_array.h"
#include "gpu/shader_folder.h"
#include "platform/context.h"
#include "support/on_context.h"

namespace tarn {
namespace {

class GlObjects : public test::OnDebugContext<> {
  protected:
    void TearDown() override { EXPECT_EQ(take_debug_errors(), std::vector<std::string>()); }

    // Runs `body` in `main` of one compute shader, `groups` groups of 64 invocations named i, after `head`.
    void compute(const std::string& head, const std::string& body, unsigned groups = 1) {
        dispatch(prepare(head, body), groups);
    }

    Program prepare(const std::string& head, const std::string& body) {
        folder_.write("a.comp", "layout(local_size_x = 64) in;\n" + head +
                                    "\nvoid main() { uint i = gl_GlobalInvocationID.x;\n" + body + "\n}\n");
        const ShaderStage stage{GL_COMPUTE_SHADER, load_shader_source(folder_.root(), "a.comp", {})};
        return Program("a", std::span(&stage, 1));
    }

    static void dispatch(const Program& program, unsigned groups = 1) {
        program.use();
        glDispatchCompute(groups, 1, 1);
        glMemoryBarrier(GL_ALL_BARRIER_BITS);
    }

    static std::string read_label(GLenum kind, GLuint id) {
        char text[256] = {};
        glGetObjectLabel(kind, id, sizeof text, nullptr, text);
        return text;
    }

    ShaderFolder folder_;
};

TEST_F(GlObjects, EachHasItsName) {
    const Buffer buffer("light table", 64, BufferUse::DEVICE);
    const Texture2D texture("normal_ws", 4, 4, GL_RGBA32F);
    const BufferTexture texels("light texels", buffer, GL_RGBA32F);
    const Framebuffer framebuffer("gbuffer", {&texture}, nullptr);
    const VertexArray vertices("meshes");
    const TimestampQuery query("start of gbuffer");
    const Program program = prepare("", "");
    EXPECT_EQ(read_label(GL_BUFFER, buffer.id()), "light table");
    EXPECT_EQ(read_label(GL_TEXTURE, texture.id()), "normal_ws");
    EXPECT_EQ(read_label(GL_TEXTURE, texels.id()), "light texels");
    EXPECT_EQ(read_label(GL_FRAMEBUFFER, framebuffer.id()), "gbuffer");
    EXPECT_EQ(read_label(GL_VERTEX_ARRAY, vertices.id()), "meshes");
    EXPECT_EQ(read_label(GL_QUERY, query.id()), "start of gbuffer");
    EXPECT_EQ(read_label(GL_PROGRAM, program.id()), "a");
}

TEST_F(GlObjects, NamesBeyondTheLimitAreCut) {
    const Buffer buffer(std::string(5000, 'x'), 16, BufferUse::DEVICE);
    EXPECT_EQ(read_label(GL_BUFFER, buffer.id()).substr(0, 10), "xxxxxxxxxx");
}

TEST_F(GlObjects, AMovedBufferHasOneOwner) {
    GLuint id = 0;
    {
        Buffer first("moved", 64, BufferUse::SHARED);
        id = first.id();
        Buffer second = std::move(first);
        EXPECT_EQ(second.id(), id);
        EXPECT_EQ(first.id(), 0u);
        first = Buffer("other", 32, BufferUse::DEVICE);
        EXPECT_TRUE(glIsBuffer(id));
        second.mapped<int>()[15] = 3;
    }
    EXPECT_FALSE(glIsBuffer(id));
}

TEST_F(GlObjects, AnEmptyBufferHas16BytesOfZeros) {
    for (const BufferUse use : {BufferUse::DEVICE, BufferUse::DYNAMIC, BufferUse::SHARED}) {
        const Buffer buffer("empty", 0, use);
        EXPECT_EQ(buffer.size_bytes(), 16u);
        EXPECT_EQ(buffer.download<int>(), std::vector<int>(4, 0));
        EXPECT_EQ(Buffer::from("empty rows", std::vector<float>(), use).download<float>(),
                  std::vector<float>(4, 0));
    }
}

TEST_F(GlObjects, BuffersStartWithTheirRows) {
    const std::vector<std::uint32_t> three = {1, 2, 3};
    const std::vector<std::uint32_t> five = {1, 2, 3, 4, 5};
    for (const BufferUse use : {BufferUse::DEVICE, BufferUse::DYNAMIC, BufferUse::SHARED}) {
        EXPECT_EQ(Buffer::from("three", three, use).download<std::uint32_t>(),
                  (std::vector<std::uint32_t>{1, 2, 3, 0}));
        EXPECT_EQ(Buffer::from("five", five, use).download<std::uint32_t>(), five);
    }
}

TEST_F(GlObjects, UploadsReplaceARange) {
    for (const BufferUse use : {BufferUse::DYNAMIC, BufferUse::SHARED}) {
        Buffer buffer("range", 20, use);
        buffer.upload(8, std::vector<int>{7, 8});
        EXPECT_EQ(buffer.download<int>(), (std::vector<int>{0, 0, 7, 8, 0}));
        buffer.clear();
        EXPECT_EQ(buffer.download<int>(), std::vector<int>(5, 0));
    }
}

TEST_F(GlObjects, TheCpuSeesWhatAShaderWroteThroughTheMapping) {
    const Buffer buffer("answers", 64 * 64 * sizeof(std::uint32_t), BufferUse::SHARED);
    buffer.bind_storage(0);
    const Program program = prepare("layout(std430, binding = 0) buffer A { uint a[]; }; uniform uint round;",
                                    "a[i] = i * 3u + round;");
    const auto mapped = buffer.mapped<std::uint32_t>();
    for (unsigned round = 0; round < 20; ++round) {
        program.set("round", round);
        dispatch(program, 64);
        const Fence fence;
        fence.wait();
        for (unsigned i = 0; i < mapped.size(); ++i) ASSERT_EQ(mapped[i], i * 3 + round);
    }
}

TEST_F(GlObjects, AShaderReadsWhatTheCpuWroteThroughABufferTexture) {
    const Buffer questions("questions", 64 * sizeof(glm::vec4), BufferUse::SHARED);
    const BufferTexture texels("question texels", questions, GL_RGBA32F);
    const Buffer sums("sums", 64 * sizeof(float), BufferUse::SHARED);
    texels.bind(0);
    sums.bind_storage(0);
    const Program program = prepare(
        "layout(binding = 0) uniform samplerBuffer q; layout(std430, binding = 0) buffer A { float a[]; };",
        "vec4 v = texelFetch(q, int(i)); a[i] = v.x + v.y * 2.0 + v.z * 4.0 + v.w * 8.0;");
    for (int round = 0; round < 20; ++round) {
        for (int i = 0; i < 64; ++i) questions.mapped<glm::vec4>()[i] = glm::vec4(i, round, i + round, 1);
        dispatch(program);
        Fence().wait();
        for (int i = 0; i < 64; ++i)
            ASSERT_EQ(sums.mapped<float>()[i], float(i + round * 2 + (i + round) * 4 + 8))
                << "round " << round;
    }
}

TEST_F(GlObjects, ABufferTheDriverCannotHoldIsAnError) {
    const std::string message =
        catch_message<Error>([] { Buffer("far too large", std::size_t(1) << 50, BufferUse::DEVICE); });
    EXPECT_NE(message.find("buffer 'far too large' of 1125899906842624 bytes"), std::string::npos) << message;
    EXPECT_THROW(Buffer("beyond any integer", ~std::size_t(0), BufferUse::SHARED), Error);
    take_debug_errors();
}

TEST_F(GlObjects, BlocksAndBufferTexturesBeyondTheLimitAreErrors) {
    const DeviceLimits& limits = context_->device_info().limits;
    const std::int64_t limit_bytes = std::max(limits.texture_buffer_texels, limits.storage_block_bytes);
    if (limit_bytes > (std::int64_t(1) << 28))
        GTEST_SKIP() << "a limit of " << limit_bytes << " bytes is not reached";
    const Buffer large("large", std::size_t(limit_bytes) + 1, BufferUse::DEVICE);
    const std::string texels = catch_message<Error>([&] { BufferTexture("large texels", large, GL_R8); });
    EXPECT_NE(texels.find("'large texels'"), std::string::npos) << texels;
    EXPECT_NE(texels.find("GL_MAX_TEXTURE_BUFFER_SIZE"), std::string::npos) << texels;
    const std::string block = catch_message<Error>([&] { large.bind_storage(0); });
    EXPECT_NE(block.find("GL_MAX_SHADER_STORAGE_BLOCK_SIZE"), std::string::npos) << block;
    EXPECT_THROW(large.bind_uniform(0), Error);
}

TEST_F(GlObjects, TexelsMakeTheRoundTrip) {
    Texture2D floats("floats", 3, 5, GL_RGB32F);
    std::vector<float> values(3 * 5 * 3);
    std::iota(values.begin(), values.end(), -7.5f);
    floats.upload(values);
    EXPECT_EQ(floats.download<float>(), values);
    Texture2D bytes("bytes", 3, 1, GL_R8);
    bytes.upload(std::vector<std::uint8_t>{0, 127, 255});
    EXPECT_EQ(bytes.download<std::uint8_t>(), (std::vector<std::uint8_t>{0, 127, 255}));
    Texture2D ids("ids", 2, 2, GL_R32UI);
    const std::vector<std::uint32_t> id_values = {0, 1, 0x80000000u, 0xffffffffu};
    ids.upload(id_values);
    EXPECT_EQ(ids.download<std::uint32_t>(), id_values);
}

TEST_F(GlObjects, ClearsSetEveryTexel) {
    Texture2D colour("colour", 7, 3, GL_RGBA32F);
    colour.clear(glm::vec4(1e-8f, -2, 3e8f, 0));
    EXPECT_EQ(colour.download<glm::vec4>(), std::vector<glm::vec4>(21, glm::vec4(1e-8f, -2, 3e8f, 0)));
    Texture2D ids("ids", 7, 3, GL_RG32UI);
    ids.clear(glm::uvec4(0xffffffffu, 5, 0, 0));
    EXPECT_EQ(ids.download<glm::uvec2>(), std::vector<glm::uvec2>(21, glm::uvec2(0xffffffffu, 5)));
    Texture2D depth("depth", 7, 3, GL_DEPTH_COMPONENT32F);
    depth.clear(glm::vec4(0.25f));
    EXPECT_EQ(depth.download<float>(), std::vector<float>(21, 0.25f));
}

TEST_F(GlObjects, ComputeShadersWriteImages) {
    Texture2D image("image", 64, 1, GL_RGBA32F);
    image.bind_image(0, GL_WRITE_ONLY);
    compute("layout(rgba32f, binding = 0) writeonly uniform image2D image;",
            "imageStore(image, ivec2(i, 0), vec4(i, 1, 2, 3));");
    for (int i = 0; i < 64; ++i) ASSERT_EQ(image.download<glm::vec4>()[i], glm::vec4(i, 1, 2, 3));
}

TEST_F(GlObjects, TexturesOfImpossibleSizesAreErrors) {
    const std::string message = catch_message<Error>([] { Texture2D("flat", 100, 0, GL_RGBA8); });
    EXPECT_NE(message.find("texture 'flat' is 100x0 px"), std::string::npos) << message;
    EXPECT_THROW(Texture2D("wide", 1 << 24, 1, GL_RGBA8), Error);
    EXPECT_THROW(Texture2D("unknown", 4, 4, 0x1234), Error);
    take_debug_errors();
}

TEST_F(GlObjects, ADrawReadsItsVerticesAndWritesItsFramebuffer) {
    folder_.write(
        "passes/draw.vert",
        "layout(location = 0) in vec2 position; layout(location = 1) in uint id; flat out uint vertex_id;\n"
        "void main() { vertex_id = id; gl_Position = vec4(position, 0.5, 1); }\n");
    folder_.write(
        "passes/draw.frag",
        "flat in uint vertex_id; layout(location = 0) out uint id; layout(location = 1) out vec4 colour;\n"
        "void main() { id = vertex_id; colour = vec4(gl_FragCoord.xy, 0, 1); }\n");
    ProgramLibrary library(folder_.root());
    Texture2D ids("ids", 8, 4, GL_R32UI);
    Texture2D colours("colours", 8, 4, GL_RGBA32F);
    const Texture2D depth("depth", 8, 4, GL_DEPTH_COMPONENT32F);
    const Framebuffer target("target", {&ids, &colours}, &depth);
    const Buffer positions = Buffer::from("positions", std::vector<glm::vec2>{{-1, -1}, {3, -1}, {-1, 3}});
    const Buffer vertex_ids = Buffer::from("ids", std::vector<std::uint32_t>{9, 9, 9});
    const Buffer indices = Buffer::from("indices", std::vector<std::uint32_t>{0, 1, 2});
    VertexArray vertices("triangle");
    vertices.add_float_attribute(0, 2, positions, 0, sizeof(glm::vec2));
    vertices.add_uint_attribute(1, 1, vertex_ids, 0, sizeof(std::uint32_t));
    vertices.set_index_buffer(indices);

    ids.clear(glm::uvec4(0));
    target.bind();
    vertices.bind();
    library.graphics("draw").use();
    glDrawElements(GL_TRIANGLES, 3, GL_UNSIGNED_INT, nullptr);
    EXPECT_EQ(ids.download<std::uint32_t>(), std::vector<std::uint32_t>(32, 9));
    EXPECT_EQ(colours.download<glm::vec4>()[8 * 3 + 5], glm::vec4(5.5f, 3.5f, 0, 1));
}

TEST_F(GlObjects, AnIncompleteFramebufferIsAnError) {
    const Texture2D depth("depth", 8, 4, GL_DEPTH_COMPONENT32F);
    const std::string message =
        catch_message<Error>([&] { Framebuffer("depth as colour", {&depth}, nullptr); });
    EXPECT_NE(message.find("framebuffer 'depth as colour'"), std::string::npos) << message;
    take_debug_errors();
}

TEST_F(GlObjects, UniformsOfEveryTypeArrive) {
    const Buffer result("result", 64 * sizeof(float), BufferUse::DEVICE);
    result.bind_storage(0);
    const Program program = prepare(
        "layout(std430, binding = 0) buffer A { float a[]; };\n"
        "uniform int n; uniform uint u; uniform float f; uniform vec2 v2; uniform vec3 v3; uniform vec4 v4;\n"
        "uniform ivec2 i2; uniform uvec2 u2; uniform mat4 m;",
        "if (i == 0u) { a[0] = float(n); a[1] = float(u); a[2] = f; a[3] = v2.y; a[4] = v3.z; a[5] = v4.w;\n"
        "a[6] = float(i2.y); a[7] = float(u2.y); a[8] = m[3][1]; }");
    glm::mat4 matrix(1.0f);
    matrix[3][1] = 9;
    program.set("n", -1);
    program.set("u", 2u);
    program.set("f", 3.5f);
    program.set("v2", glm::vec2(0, 4));
    program.set("v3", glm::vec3(0, 0, 5));
    program.set("v4", glm::vec4(0, 0, 0, 6));
    program.set("i2", glm::ivec2(0, -7));
    program.set("u2", glm::uvec2(0, 8));
    program.set("m", matrix);
    dispatch(program);
    const std::vector<float> values = result.download<float>();
    EXPECT_EQ(std::vector<float>(values.begin(), values.begin() + 9),
              (std::vector<float>{-1, 2, 3.5f, 4, 5, 6, -7, 8, 9}));
}

TEST_F(GlObjects, TimestampsFollowTheWork) {
    const Buffer buffer("work", 64 * 256 * sizeof(float), BufferUse::DEVICE);
    buffer.bind_storage(0);
    const Program program =
        prepare("layout(std430, binding = 0) buffer A { float a[]; }; uniform int steps;",
                "float x = float(i); for (int s = 0; s < steps; ++s) x = sin(x) + 1.0; a[i] = x;");
    // Compiling at the first dispatch is not the work that is timed.
    program.set("steps", 1);
    dispatch(program, 256);
    Fence().wait();

    TimestampQuery times[3] = {TimestampQuery("start"), TimestampQuery("light"), TimestampQuery("heavy")};
    const auto wall_start = std::chrono::steady_clock::now();
    times[0].record();
    dispatch(program, 256);
    times[1].record();
    program.set("steps", 6000);
    dispatch(program, 256);
    times[2].record();
    const std::uint64_t end_ns = times[2].read_ns();
    const auto wall_ns = std::chrono::nanoseconds(std::chrono::steady_clock::now() - wall_start).count();
    const std::uint64_t light_ns = times[1].read_ns() - times[0].read_ns();
    const std::uint64_t heavy_ns = end_ns - times[1].read_ns();
    EXPECT_GT(heavy_ns, 4 * light_ns);
    // The device's clock may tick a little apart from ours; it cannot have worked longer than we waited.
    EXPECT_LT(double(light_ns + heavy_ns), 1.1 * double(wall_ns));
    EXPECT_GT(double(light_ns + heavy_ns), 0.3 * double(wall_ns));
}

TEST_F(GlObjects, TheDriversComplaintsAreKept) {
    glBindBuffer(GL_ARRAY_BUFFER + 12345, 0);
    const std::vector<std::string> errors = take_debug_errors();
    ASSERT_EQ(errors.size(), 1u);
    EXPECT_NE(errors[0].find("glBindBuffer"), std::string::npos) << errors[0];
    EXPECT_EQ(take_debug_errors(), std::vector<std::string>());
    EXPECT_THROW(check_gl("binding nothing"), Error);
    EXPECT_NO_THROW(check_gl("nothing left"));
}

TEST_F(GlObjects, DebugGroupsNest) {
    const auto read_depth = [] { return get_gl_limit(GL_DEBUG_GROUP_STACK_DEPTH); };
    const GLint64 depth = read_depth();
    {
        const DebugGroup outer("direct");
        const DebugGroup inner("direct/temporal");
        EXPECT_EQ(read_depth(), depth + 2);
    }
    EXPECT_EQ(read_depth(), depth);
}

}  // namespace
}  // namespace tarn
