// The light tree over odd tables of lights: none, one, all at one place, many decades of intensity.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "support/light_tree_cases.h"

namespace tarn {
namespace {

using namespace test;

TEST(LightTree, WithoutLightsThereIsNothingToDraw) {
    const LitWorld world = build_lit_world(ToyScene().scene);
    SceneAccess access(world, &world.light_tree);
    EXPECT_EQ(access.get_light_tree_node_count(), 0u);
    const auto none = access.draw_light_by_tree(uvec4(1u), vec3(0.0f), vec3(0.0f, 1.0f, 0.0f));
    EXPECT_EQ(none.drawn.light, INVALID_INDEX);
    EXPECT_EQ(none.pdf, 0.0f);
}

TEST(LightTree, OneLightIsAlwaysDrawn) {
    for (const LightKind kind : {LightKind::POINT, LightKind::SPOT, LightKind::DIRECTIONAL}) {
        LightScene lights(10);
        lights.add_punctual(kind);
        const LitWorld world = build_lit_world(lights.scene());
        expect_sums_to_one(world);
    }
}

TEST(LightTree, DirectionalLightsShareTheirShareAlike) {
    const LitWorld world = build_random_world(11, 20);
    int directional = 0;
    for (std::uint32_t i = 0; i < world.lights.count; ++i) {
        SceneAccess access(world, &world.light_tree);
        if ((access.load_light(i).flags & LIGHT_KIND_MASK) != LIGHT_DIRECTIONAL) continue;
        ++directional;
        EXPECT_EQ(access.light_tree_pmf(i, vec3(0.0f), vec3(0.0f, 1.0f, 0.0f)), DIRECTIONAL_SHARE / 2.0f);
    }
    EXPECT_EQ(directional, 2);
}

TEST(LightTree, ManyLightsAtOnePlaceShareAlike) {
    ToyScene toy;
    for (int i = 0; i < 1000; ++i) toy.add_light(PunctualLight{}, glm::dmat4(1.0));
    const LitWorld world = build_lit_world(toy.scene);
    const std::vector<float> pmf = list_pmf(world, {vec3(1.0f, 0.0f, 0.0f), vec3(-1.0f, 0.0f, 0.0f)});
    for (const float p : pmf) EXPECT_NEAR(p, 1e-3, 1e-4);
    expect_sums_to_one(world);
}

TEST(LightTree, LightsInARowAreDividedToo) {
    ToyScene toy;
    for (int i = 0; i < 300; ++i) {
        toy.add_light(PunctualLight{}, glm::translate(glm::dmat4(1.0), glm::dvec3(0.01 * i, 0.0, 0.0)));
    }
    expect_sums_to_one(build_lit_world(toy.scene));
}

// Each division would take one light off the end of a series that halves: 200 levels.
TEST(LightTree, NoTrailIsLongerThanItsBits) {
    ToyScene toy;
    for (int i = 0; i < 120; ++i) {
        PunctualLight light;
        light.intensity = vec3(float(std::pow(2.0, 0.5 * i)));
        toy.add_light(light, glm::translate(glm::dmat4(1.0), glm::dvec3(std::pow(0.5, i), 0.0, 0.0)));
    }
    const LitWorld world = build_lit_world(toy.scene);
    const LightTree& tree = world.light_tree;
    std::uint32_t deepest = 0;
    for (const std::uint32_t leaf : tree.leaves) {
        std::uint32_t depth = 0;
        for (std::uint32_t node = leaf; node != 0; node = tree.parents[(node - 2) / 2]) ++depth;
        deepest = std::max(deepest, depth);
    }
    EXPECT_LE(deepest, LIGHT_TREE_MAX_DEPTH);
    EXPECT_GT(deepest, 10u) << "the series must be a hard one";
    expect_sums_to_one(world);
}

TEST(LightTree, IntensitiesOverManyDecadesAllCount) {
    ToyScene toy;
    for (int i = 0; i < 64; ++i) {
        PunctualLight light;
        light.intensity = vec3(float(std::pow(10.0, -8.0 + 16.0 * i / 63.0)));
        toy.add_light(light, glm::translate(glm::dmat4(1.0), glm::dvec3(0.1 * i, 0.0, 0.0)));
    }
    const LitWorld world = build_lit_world(toy.scene);
    expect_sums_to_one(world);
    for (const float p : list_pmf(world, {vec3(3.0f, -1.0f, 0.0f), vec3(0.0f, 1.0f, 0.0f)}))
        EXPECT_GT(p, 0.0f);
}

}  // namespace
}  // namespace tarn
