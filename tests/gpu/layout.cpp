// Where each field of a record lies: packed in C++ and unpacked by a shader through a texture buffer, packed
// by a shader into a storage buffer and unpacked in C++; and the offsets of the frame's uniform block as the
// driver sees them.
#include <gtest/gtest.h>

#include <bit>
#include <cstddef>

#include "gl/buffer.h"
#include "gl/program_library.h"
#include "gl/texture.h"
#include "gpu/layout_records.h"
#include "gpu/shader_folder.h"
#include "shared/interface/frame_block.h"
#include "support/draws.h"
#include "support/on_context.h"
#include "support/toy_scenes.h"
#include "world/world.h"

namespace tarn::test {
namespace {

constexpr std::size_t ITEM_COUNT = 256;
constexpr std::size_t GROUP_SIZE = 64;

const char* const PRELUDE = R"(
#include "shared/interface/records.h"
#include "shared/math/alias_table.h"
#include "shared/math/light.h"
#include "shared/math/light_sample.h"
#include "shared/math/reservoir.h"
layout(local_size_x = 64) in;
)";

const char* const UNPACK_SHADER = R"(
layout(binding = 0) uniform usamplerBuffer rows;
layout(std430, binding = 0) writeonly buffer Fields { uint fields[]; };
uint next = gl_GlobalInvocationID.x * WORDS;
uvec4 row(uint i) { return texelFetch(rows, int(gl_GlobalInvocationID.x * ROWS + i)); }
void put(uint word) { fields[next++] = word; }
void put(float value) { put(floatBitsToUint(value)); }
void put(vec2 v) { put(v.x); put(v.y); }
void put(vec3 v) { put(v.x); put(v.y); put(v.z); }
void put(vec4 v) { put(v.xyz); put(v.w); }
)";

const char* const PACK_SHADER = R"(
layout(std430, binding = 0) readonly buffer Fields { uint fields[]; };
layout(std430, binding = 1) writeonly buffer Rows { uvec4 rows[]; };
uint next = gl_GlobalInvocationID.x * WORDS;
uint take() { return fields[next++]; }
float take1() { return uintBitsToFloat(take()); }
vec2 take2() { vec2 v; v.x = take1(); v.y = take1(); return v; }
vec3 take3() { vec3 v; v.xy = take2(); v.z = take1(); return v; }
vec4 take4() { vec4 v; v.xyz = take3(); v.w = take1(); return v; }
void store(uint i, uvec4 row) { rows[gl_GlobalInvocationID.x * ROWS + i] = row; }
)";

Words random_fields(const Record& record) {
    const float odd[] = {0.0f, -0.0f, 1e30f, -1e-30f, 1.0f};
    Draws draws(record.fields.size());
    Words words;
    for (std::size_t i = 0; i < ITEM_COUNT; ++i) {
        for (const char kind : record.fields) {
            const std::uint32_t bits = draws.bits();
            const float value = bits % 4u == 0u ? odd[bits / 4u % 5u] : float(draws.uniform(-1e3, 1e3));
            words.push_back(kind == 'u'   ? bits
                            : kind == 'f' ? floatBitsToUint(value)
                                          : floatBitsToUint(float(bits & 0xffffu) / 65535.0f));
        }
    }
    return words;
}

class Layout : public OnContext<testing::TestWithParam<Record>> {
  protected:
    Layout() {
        std::filesystem::create_directory_symlink(
            std::filesystem::path(TARN_SOURCE_DIR) / "shaders" / "shared", folder_.root() / "shared");
    }

    static std::size_t words_of(const Record& r) { return r.fields.size(); }

    void dispatch(const Record& record, const char* access, const std::string& body) {
        folder_.write("layout.comp", PRELUDE + std::string(access) + "void main() {" + body + "}\n");
        const std::vector<std::string> defines = {fmt::format("WORDS={}u", words_of(record)),
                                                  fmt::format("ROWS={}u", record.rows)};
        const ShaderStage stage{GL_COMPUTE_SHADER,
                                load_shader_source(folder_.root(), "layout.comp", defines)};
        const Program program("layout", std::span(&stage, 1));
        program.use();
        glDispatchCompute(ITEM_COUNT / GROUP_SIZE, 1, 1);
        glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
    }

    // What a shader finds in rows that C++ packed.
    Words unpack_on_gl(const Record& record, const Rows& rows) {
        const Buffer buffer = Buffer::from("rows", rows);
        const BufferTexture texture("rows", buffer, GL_RGBA32UI);
        const Buffer fields("fields", rows.size() / record.rows * words_of(record) * sizeof(std::uint32_t),
                            BufferUse::DEVICE);
        texture.bind(0);
        fields.bind_storage(0);
        dispatch(record, UNPACK_SHADER, record.glsl_unpack);
        return fields.download<std::uint32_t>();
    }

    Rows pack_on_gl(const Record& record, const Words& fields) {
        const Buffer in = Buffer::from("fields", fields);
        const Buffer out("rows", ITEM_COUNT * record.rows * sizeof(glm::uvec4), BufferUse::DEVICE);
        in.bind_storage(0);
        out.bind_storage(1);
        dispatch(record, PACK_SHADER, record.glsl_pack);
        return out.download<glm::uvec4>();
    }

    // First field of which item differs; "" where all are the same bits.
    static std::string find_difference(const Record& record, const Words& expected, const Words& actual) {
        if (expected.size() != actual.size()) return "another number of fields";
        for (std::size_t i = 0; i < expected.size(); ++i) {
            if (expected[i] == actual[i]) continue;
            // A driver may divide by 65535 with another rounding.
            const bool is_norm = record.fields[i % words_of(record)] == 'n';
            const float a = std::bit_cast<float>(expected[i]), b = std::bit_cast<float>(actual[i]);
            if (is_norm && std::abs(a - b) < 1e-6f) continue;
            return fmt::format("item {}, field {}: {:#x} became {:#x}", i / words_of(record),
                               i % words_of(record), expected[i], actual[i]);
        }
        return "";
    }

    ShaderFolder folder_;
};

TEST_P(Layout, ShadersUnpackWhatCppPacked) {
    const Record& record = GetParam();
    const Words fields = random_fields(record);
    Rows rows(ITEM_COUNT * record.rows);
    for (std::size_t i = 0; i < ITEM_COUNT; ++i) {
        FieldReader reader(&fields[i * words_of(record)]);
        record.pack(reader, &rows[i * record.rows]);
    }
    EXPECT_EQ(find_difference(record, fields, unpack_on_gl(record, rows)), "");
}

TEST_P(Layout, CppUnpacksWhatShadersPacked) {
    const Record& record = GetParam();
    const Words fields = random_fields(record);
    const Rows rows = pack_on_gl(record, fields);
    FieldWriter writer;
    for (std::size_t i = 0; i < ITEM_COUNT; ++i) record.unpack(&rows[i * record.rows], writer);
    EXPECT_EQ(find_difference(record, fields, writer.words), "");
}

INSTANTIATE_TEST_SUITE_P(Records, Layout,
                         testing::Values(vertex_record(), material_record(), slot_record(), light_record(),
                                         reservoir_record(), ray_record(), hit_record(), alias_record()),
                         [](const auto& info) { return info.param.name; });

// ---- Records that only the world packs ----------------------------------------------------------

class WorldLayout : public Layout {};

TEST_F(WorldLayout, ShadersUnpackInstancesAsTheWorldPlacesThem) {
    ToyScene toy;
    const MaterialIndex first = toy.add_material(lambert_material(glm::vec3(0.5f)));
    const MaterialIndex second = toy.add_material(lambert_material(glm::vec3(0.25f)));
    toy.add_quad(first, {-1, 0, -1}, {2, 0, 0}, {0, 0, 2});
    const MeshIndex mesh = toy.add_mesh(second, {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
    const glm::dmat4 mirror = glm::scale(glm::dmat4(1.0), {-1.0, 2.0, 3.0});
    toy.add_instance(mesh, glm::translate(glm::dmat4(1.0), {0.25, 0.5, -0.75}) * mirror);
    const World world = build_world(toy.scene);
    ASSERT_EQ(world.instances.size(), 2u);
    Rows rows = world.instance_rows;
    rows.resize(ITEM_COUNT * INSTANCE_ROWS);
    Record record{"instance", INSTANCE_ROWS, "ffffffffffffuuuu", {}, {}, {}, {}};
    record.glsl_unpack = R"(
        InstanceRecord r = unpack_instance(row(0u), row(1u), row(2u), row(3u));
        put(r.world_from_object[0]); put(r.world_from_object[1]); put(r.world_from_object[2]);
        put(r.first_triangle); put(r.first_vertex); put(r.material); put(r.flags);)";
    const Words fields = unpack_on_gl(record, rows);
    const glm::dvec3 place = glm::dvec3(0.25, 0.5, -0.75) - world.origin_ws;
    FieldWriter expected;
    expected.put(vec4(-1, 0, 0, float(place.x)));
    expected.put(vec4(0, 2, 0, float(place.y)));
    expected.put(vec4(0, 0, 3, float(place.z)));
    for (const std::uint32_t word : {2u, 6u, 1u, INSTANCE_MIRRORED}) expected.put(word);
    for (std::size_t i = 0; i < 16; ++i) {
        const std::uint32_t actual = fields[16 + i];
        if (i < 12) {
            EXPECT_EQ(std::bit_cast<float>(actual), std::bit_cast<float>(expected.words[i])) << "field " << i;
        } else {
            EXPECT_EQ(actual, expected.words[i]) << "field " << i;
        }
    }
}

// ---- The frame's uniform block ------------------------------------------------------------------

GLint query(GLuint program, GLenum interface, GLuint index, GLenum property) {
    GLint value = -1;
    glGetProgramResourceiv(program, interface, index, 1, &property, 1, nullptr, &value);
    return value;
}

class BlockLayout : public Layout {};

TEST_F(BlockLayout, TheFrameBlockHasTheDriversOffsets) {
    folder_.write("frame.comp", R"(
        #include "shared/interface/frame_block.h"
        layout(local_size_x = 1) in;
        layout(std430, binding = 0) writeonly buffer Sums { vec4 sum; };
        void main() {
            sum = frame_camera_position + frame_camera_right + frame_camera_up + frame_camera_forward +
                  vec4(frame_size) + vec4(frame_lights);
        })");
    const ShaderStage stage{GL_COMPUTE_SHADER, load_shader_source(folder_.root(), "frame.comp", {})};
    const Program program("frame", std::span(&stage, 1));
    const std::pair<const char*, std::size_t> members[] = {
        {"frame_camera_position", offsetof(FrameBlock, frame_camera_position)},
        {"frame_camera_right", offsetof(FrameBlock, frame_camera_right)},
        {"frame_camera_up", offsetof(FrameBlock, frame_camera_up)},
        {"frame_camera_forward", offsetof(FrameBlock, frame_camera_forward)},
        {"frame_size", offsetof(FrameBlock, frame_size)},
        {"frame_lights", offsetof(FrameBlock, frame_lights)},
        {"frame_previous_position", offsetof(FrameBlock, frame_previous_position)},
        {"frame_previous_right", offsetof(FrameBlock, frame_previous_right)},
        {"frame_previous_up", offsetof(FrameBlock, frame_previous_up)},
        {"frame_previous_forward", offsetof(FrameBlock, frame_previous_forward)},
        {"frame_history", offsetof(FrameBlock, frame_history)},
        {"frame_jitter", offsetof(FrameBlock, frame_jitter)},
        {"frame_tables", offsetof(FrameBlock, frame_tables)},
        {"frame_full", offsetof(FrameBlock, frame_full)},
        {"frame_offset", offsetof(FrameBlock, frame_offset)},
    };
    for (const auto& [name, offset] : members) {
        const GLuint index = glGetProgramResourceIndex(program.id(), GL_UNIFORM, name);
        ASSERT_NE(index, GL_INVALID_INDEX) << name;
        EXPECT_EQ(query(program.id(), GL_UNIFORM, index, GL_OFFSET), GLint(offset)) << name;
    }
    const GLuint block = glGetProgramResourceIndex(program.id(), GL_UNIFORM_BLOCK, "FrameBlock");
    ASSERT_NE(block, GL_INVALID_INDEX);
    EXPECT_EQ(query(program.id(), GL_UNIFORM_BLOCK, block, GL_BUFFER_DATA_SIZE), GLint(sizeof(FrameBlock)));
    EXPECT_EQ(query(program.id(), GL_UNIFORM_BLOCK, block, GL_BUFFER_BINDING), BLOCK_FRAME);
    EXPECT_EQ(query(program.id(), GL_UNIFORM_BLOCK, block, GL_NUM_ACTIVE_VARIABLES),
              GLint(std::size(members)));
}

}  // namespace
}  // namespace tarn::test
