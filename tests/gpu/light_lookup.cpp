// The light that a ray has met, as shaders find it in GL memory: for every triangle and for the sky, while
// lights come and go, and with more of them than there was room for at first.
#include <gtest/gtest.h>

#include <functional>

#include "gl/program.h"
#include "gpu/shader_folder.h"
#include "passes/gpu_scene.h"
#include "platform/context.h"
#include "shared/interface/bindings.h"
#include "support/draws.h"
#include "support/toy_scenes.h"
#include "world/scene_access.h"

namespace tarn::test {
namespace {

constexpr std::uint32_t GROUP_SIZE = 64;

const char* const SHADER = R"(
#include "lib/scene_buffers.glsl"
#include "lib/light_hits.glsl"
layout(local_size_x = 64) in;
layout(std430, binding = 0) readonly buffer Hits { uvec4 hits[]; };
layout(std430, binding = 1) writeonly buffer Samples { uvec4 samples[]; };
void main() {
    uint i = gl_GlobalInvocationID.x;
    LightSample found = find_light_sample(unpack_hit(hits[i * HIT_ROWS], hits[i * HIT_ROWS + 1u]));
    samples[i] = uvec4(found.light, floatBitsToUint(found.uv.x), floatBitsToUint(found.uv.y), 0u);
}
)";

// Quads that glow or do not, each on a node and of a material of its own, under a sky.
class Lamps {
  public:
    explicit Lamps(int count) {
        for (int i = 0; i < count; ++i) {
            const MaterialIndex material = toy_.add_material(emissive_material(glm::vec3(1.0f)));
            std::vector<vec3> corners;
            for (int t = 0; t < 1 + i % 5; ++t) {
                const vec3 at(float(i), float(t), 0.0f);
                // Each third triangle is a line, and no light.
                corners.insert(corners.end(),
                               {at, at + vec3(0.5f, 0, 0),
                                at + vec3(t % 3 == 2 ? 1.0f : 0.0f, t % 3 == 2 ? 0.0f : 0.5f, 0)});
            }
            toy_.add_instance(toy_.add_mesh(material, corners));
        }
    }

    void glow_if(const std::function<bool(std::size_t)>& choose) {
        for (std::size_t i = 0; i < toy_.scene.materials.size(); ++i) {
            toy_.scene.materials[i].emission = glm::vec3(choose(i) ? 1.0f : 0.0f);
        }
        ++toy_.scene.revision;
    }
    Scene& scene() { return toy_.scene; }

  private:
    ToyScene toy_;
};

std::vector<glm::uvec4> list_hits(const World& world, Draws& draws) {
    std::vector<HitRecord> hits;
    for (std::uint32_t i = 0; i < world.instances.size(); ++i) {
        for (std::uint32_t p = 0; p < world.meshes[world.instances[i].mesh].triangle_count; ++p) {
            hits.push_back({i, p, draws.uniform_vec2(), draws.unit_vector(), 1.0f});
        }
    }
    for (int i = 0; i < 100; ++i) hits.push_back(no_hit(draws.unit_vector(), i % 4 != 0));
    while (hits.size() % GROUP_SIZE != 0) hits.push_back(no_hit(vec3(0.0f, 0.0f, 1.0f), false));
    std::vector<glm::uvec4> rows(hits.size() * HIT_ROWS);
    for (std::size_t i = 0; i < hits.size(); ++i) {
        pack_hit(hits[i], rows[i * HIT_ROWS], rows[i * HIT_ROWS + 1]);
    }
    return rows;
}

// What the hit must find, without the tables that are tested: by a search through all lights.
glm::uvec4 find_by_search(const World& world, const HitRecord& hit) {
    const glm::uvec4 nothing(INVALID_INDEX, 0u, 0u, 0u);
    if (hit.instance == INVALID_INDEX) {
        if (hit.distance < 0.0f || world.environment.width == 0) return nothing;
        const vec2 uv = encode_octahedral(hit.direction);
        return {LIGHT_ENVIRONMENT, floatBitsToUint(uv.x), floatBitsToUint(uv.y), 0u};
    }
    SceneAccess access(world);
    for (std::uint32_t i = 0; i < world.lights.count; ++i) {
        const Light light = access.load_light(i);
        if ((light.flags & LIGHT_KIND_MASK) != LIGHT_TRIANGLE || light.instance != hit.instance ||
            light.primitive != hit.primitive)
            continue;
        return {i, floatBitsToUint(hit.barycentrics.x), floatBitsToUint(hit.barycentrics.y), 0u};
    }
    return nothing;
}

class LightLookup : public testing::Test {
  protected:
    static void SetUpTestSuite() { context_ = create_context({}); }
    static void TearDownTestSuite() { context_.reset(); }

    LightLookup() {
        for (const char* name : {"shared", "lib"}) {
            std::filesystem::create_directory_symlink(
                std::filesystem::path(TARN_SOURCE_DIR) / "shaders" / name, folder_.root() / name);
        }
        folder_.write("find.comp", SHADER);
    }

    std::vector<glm::uvec4> find_on_gl(const GpuScene& scene, const World& world,
                                       const std::vector<glm::uvec4>& hits) {
        const std::vector<std::string> defines = {"TARN_TRIANGLE_LIGHTS", "TARN_ENVIRONMENT"};
        const ShaderStage stage{GL_COMPUTE_SHADER, load_shader_source(folder_.root(), "find.comp", defines)};
        const Program program("find", std::span(&stage, 1));
        FrameBlock block{};
        block.frame_lights =
            glm::uvec4(world.lights.count, world.environment.width, world.environment.height, 0u);
        block.frame_tables = glm::uvec4(0u, scene.lights().instance_lookup_first_row(),
                                        scene.lights().slot_lookup_first_row(), 0u);
        const Buffer frame = Buffer::from("frame", std::span<const FrameBlock>(&block, 1));
        const Buffer in = Buffer::from("hits", hits);
        const std::size_t count = hits.size() / HIT_ROWS;
        const Buffer out("samples", count * sizeof(glm::uvec4), BufferUse::DEVICE);
        frame.bind_uniform(BLOCK_FRAME);
        in.bind_storage(0);
        out.bind_storage(1);
        FrameRecorder recorder;
        scene.bind(recorder);
        program.use();
        glDispatchCompute(GLuint(count / GROUP_SIZE), 1, 1);
        glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
        return out.download<glm::uvec4>();
    }

    // Every hit of the world finds, in a shader and on the CPU, the light that a search finds.
    void expect_found(const GpuScene& scene, const World& world) {
        Draws draws(world.lights.count);
        const std::vector<glm::uvec4> hits = list_hits(world, draws);
        const std::vector<glm::uvec4> on_gl = find_on_gl(scene, world, hits);
        SceneAccess access(world);
        int wrong = 0;
        for (std::size_t i = 0; i < on_gl.size(); ++i) {
            const HitRecord hit = unpack_hit(hits[i * HIT_ROWS], hits[i * HIT_ROWS + 1]);
            const glm::uvec4 expected = find_by_search(world, hit);
            const LightSample on_cpu = access.find_light_sample(hit);
            wrong += on_gl[i] != expected;
            wrong += on_cpu.light != expected.x || floatBitsToUint(on_cpu.uv.x) != expected.y ||
                     floatBitsToUint(on_cpu.uv.y) != expected.z;
        }
        EXPECT_EQ(wrong, 0);
    }

    ShaderFolder folder_;
    static inline std::unique_ptr<Context> context_;
};

TEST_F(LightLookup, EachHitFindsItsLight) {
    Lamps lamps(60);
    lamps.glow_if([](std::size_t i) { return i % 3 != 0; });
    for (const bool has_sky : {true, false}) {
        const World world = build_world(lamps.scene(), has_sky ? even_sky(glm::vec3(1.0f)) : WorldOptions{});
        ASSERT_GT(world.lights.count, 50u);
        expect_found(GpuScene(world), world);
    }
}

TEST_F(LightLookup, ItFollowsLightsThatComeAndGo) {
    Lamps lamps(200);
    lamps.glow_if([](std::size_t i) { return i == 7; });
    World world = build_world(lamps.scene());
    GpuScene scene(world);
    expect_found(scene, world);
    Draws draws(5);
    for (const double share : {0.02, 0.5, 0.1, 0.9, 0.9, 0.0, 0.3}) {
        lamps.glow_if([&](std::size_t) { return draws.uniform() < share; });
        update_world(world, lamps.scene(), -1.0);
        scene.update(world);
        expect_found(scene, world);
        scene.advance(world);
    }
}

// Instances without any light at first: few lights, a long table.
TEST_F(LightLookup, ItFollowsManyTrianglesThatAreNoLightsYet) {
    Lamps lamps(50);
    lamps.glow_if([](std::size_t i) { return i % 5 == 4; });
    World world = build_world(lamps.scene());
    GpuScene scene(world);
    for (Node& node : lamps.scene().nodes) node.matrix = glm::scale(glm::dmat4(1.0), glm::dvec3(0.0));
    lamps.glow_if([](std::size_t) { return true; });
    update_world(world, lamps.scene(), -1.0);
    ASSERT_EQ(world.lights.count, 0u);
    scene.update(world);
    expect_found(scene, world);
}

}  // namespace
}  // namespace tarn::test
