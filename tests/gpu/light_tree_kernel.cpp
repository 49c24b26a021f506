// Drawing by the light tree in a compute shader against the same text compiled as C++.
#include <gtest/gtest.h>

#include <cmath>

#include "gl/buffer.h"
#include "gl/program.h"
#include "gpu/shader_folder.h"
#include "platform/context.h"
#include "support/light_scenes.h"
#include "world/scene_access.h"

namespace tarn {
namespace {

constexpr std::uint32_t ITEM_COUNT = 16'384;
constexpr std::uint32_t GROUP_SIZE = 64;

struct Item {
    uvec4 position;  // and the light whose probability is asked for
    uvec4 normal;
    uvec4 bits;
};

std::vector<Item> make_items(const World& world) {
    test::Draws draws(1);
    std::vector<Item> items(ITEM_COUNT);
    for (Item& item : items) {
        item.position = pack_row(draws.unit_vector() * float(draws.uniform(0.0, 10.0)),
                                 draws.bits() % world.lights.count);
        item.normal = pack_row(draws.unit_vector(), 0u);
        item.bits = uvec4(draws.bits(), draws.bits(), draws.bits(), draws.bits());
    }
    return items;
}

std::vector<uvec4> draw_on_gl(const World& world, const LightTree& light_tree,
                              const std::vector<Item>& items) {
    const auto context = create_context({});
    const ShaderFolder folder;
    const std::filesystem::path source = TARN_SOURCE_DIR;
    std::filesystem::create_directory_symlink(source / "shaders" / "shared", folder.root() / "shared");
    std::filesystem::create_directory_symlink(source / "tests" / "gpu", folder.root() / "gpu");
    const ShaderStage stage{GL_COMPUTE_SHADER,
                            load_shader_source(folder.root(), "gpu/shaders/light_tree.comp", {})};
    Program program("light_tree", std::span(&stage, 1));
    const Buffer inputs = Buffer::from("inputs", items), lights = Buffer::from("lights", world.lights.rows),
                 tree = Buffer::from("tree", light_tree.rows);
    const Buffer outputs("outputs", items.size() * sizeof(uvec4), BufferUse::DEVICE);
    inputs.bind_storage(0);
    outputs.bind_storage(1);
    lights.bind_storage(2);
    tree.bind_storage(3);
    program.set("node_count", light_tree.node_count);
    program.use();
    glDispatchCompute(ITEM_COUNT / GROUP_SIZE, 1, 1);
    glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
    return outputs.download<uvec4>();
}

bool is_near(std::uint32_t gl_bits, float cpp) {
    return std::abs(uintBitsToFloat(gl_bits) - cpp) <= 1e-9f + 1e-3f * cpp;
}

// A driver's roots and divisions differ in their last bits: a number that falls between the two shares of a
// level, or a light at the very edge of a cone, may go the other way. One in a thousand may.
TEST(LightTreeKernel, DrawsTheSameLightsWithTheSameProbability) {
    test::LightScene lights(3);
    lights.add_lights(2000, true);
    const World world = build_world(lights.scene());
    LightTree light_tree;
    update_light_tree(light_tree, world.lights);
    const std::vector<Item> items = make_items(world);
    const std::vector<uvec4> on_gl = draw_on_gl(world, light_tree, items);
    SceneAccess access(world, &light_tree);
    std::uint32_t other_light = 0, other_pmf = 0, other_pdf = 0;
    for (std::size_t i = 0; i < items.size(); ++i) {
        const vec3 position = row_xyz(items[i].position), normal = row_xyz(items[i].normal);
        const DiscreteSample drawn = access.choose_light_by_tree(items[i].bits, position, normal);
        const auto candidate = access.draw_light_by_tree(items[i].bits, position, normal);
        const bool same = on_gl[i].x == drawn.index;
        other_light += !same;
        other_pmf += same && !is_near(on_gl[i].y, drawn.pmf);
        other_pmf += !is_near(on_gl[i].z, access.light_tree_pmf(items[i].position.w, position, normal));
        other_pdf += same && !is_near(on_gl[i].w, candidate.pdf);
    }
    EXPECT_LE(other_light, ITEM_COUNT / 1000);
    EXPECT_LE(other_pmf, ITEM_COUNT / 1000);
    EXPECT_LE(other_pdf, ITEM_COUNT / 1000);
}

}  // namespace
}  // namespace tarn
