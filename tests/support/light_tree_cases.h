// Worlds with a light tree and what holds of every one of them; shared by the tests of its draws and of its
// bounds.
#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <vector>

#include "support/light_scenes.h"
#include "world/light_tree.h"
#include "world/scene_access.h"

namespace tarn::test {

// A place on a surface; all spaces are relative to the world's origin.
struct Receiver {
    vec3 position;
    vec3 normal;
};

// A world and a tree over its lights.
struct LitWorld : World {
    LightTree light_tree;
};

// Brings the tree up to date.
inline void follow_lights(LitWorld& world) {
    update_light_tree(world.light_tree, world.lights);
}

inline LitWorld build_lit_world(const Scene& scene) {
    LitWorld world{build_world(scene), {}};
    follow_lights(world);
    return world;
}

inline LitWorld build_random_world(std::uint64_t seed, int count, bool directional = true) {
    LightScene lights(seed);
    lights.add_lights(count, directional);
    return build_lit_world(lights.scene());
}

// A point anywhere, on a light, or a hair beside one.
inline Receiver draw_point(const World& world, Draws& draws) {
    Receiver point{draws.unit_vector() * float(draws.uniform(0.0, 12.0)), draws.unit_vector()};
    const std::uint32_t choice = draws.bits() % 4u;
    if (choice > 1u || world.lights.count == 0) return point;
    SceneAccess access(world);
    const Light light = access.load_light(draws.bits() % world.lights.count);
    point.position = access.is_triangle(light) ? triangle_point(light, vec2(0.3f, 0.3f)) : light.position;
    if (choice == 1u) point.position += draws.unit_vector() * 1e-4f;
    return point;
}

inline std::vector<float> list_pmf(const LitWorld& world, const Receiver& point) {
    SceneAccess access(world, &world.light_tree);
    std::vector<float> pmf(world.lights.count);
    for (std::uint32_t i = 0; i < world.lights.count; ++i) {
        pmf[i] = access.light_tree_pmf(i, point.position, point.normal);
    }
    return pmf;
}

inline double sum_of(const std::vector<float>& values) {
    double sum = 0.0;
    for (const float value : values) sum += value;
    return sum;
}

// The probabilities of all lights, at some points.
inline void expect_sums_to_one(const LitWorld& world) {
    Draws draws(7);
    for (int i = 0; i < 20; ++i) {
        EXPECT_NEAR(sum_of(list_pmf(world, draw_point(world, draws))), 1.0, 1e-5);
    }
}

}  // namespace tarn::test
