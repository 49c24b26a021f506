// The light tree as it is built and as it is fitted to lights that moved: bounds by looking at every light
// below every node, and what an update writes.
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>

#include "support/light_tree_cases.h"
#include "world/light_tree.h"
#include "world/scene_access.h"

namespace tarn {
namespace {

using namespace test;

struct Violations {
    int place = 0, normal = 0, intensity = 0;
};

// Whether the light's normal is outside of the node's cone by more than a tenth of what draws allow for.
bool is_outside_cone(const LightTreeNode& node, const Light& light) {
    glm::dvec3 normal = cross(glm::dvec3(light.edge1), glm::dvec3(light.edge2));
    if ((light.flags & LIGHT_MIRRORED) != 0u) normal = -normal;
    const glm::dvec3 axis(node.axis);
    double cosine = dot(axis, normal);
    if ((node.link & LIGHT_TREE_TWO_SIDED) != 0u) cosine = std::abs(cosine);
    const double angle_rad = std::atan2(glm::length(glm::cross(axis, normal)), cosine);
    return angle_rad > std::acos(double(node.cos_normals)) + 0.1 * LIGHT_TREE_SLACK;
}

// Walks down and compares each node with every light below it; returns those lights.
std::vector<std::uint32_t> check_node(const LitWorld& world, std::uint32_t index, Violations& violations) {
    SceneAccess access(world, &world.light_tree);
    const LightTreeNode node = access.load_light_tree_node(index);
    const std::uint32_t link = node.link & LIGHT_TREE_INDEX_MASK;
    std::vector<std::uint32_t> below;
    if ((node.link & LIGHT_TREE_LEAF) != 0u) {
        below.push_back(link);
    } else {
        below = check_node(world, link, violations);
        const std::vector<std::uint32_t> right = check_node(world, link + 1, violations);
        below.insert(below.end(), right.begin(), right.end());
    }
    double intensity = 0.0;
    for (const std::uint32_t i : below) {
        const Light light = access.load_light(i);
        intensity += bound_light(light, world.lights.powers[i]).intensity;
        const bool triangle = access.is_triangle(light);
        for (const vec2 corner : {vec2(0, 0), vec2(1, 0), vec2(0, 1)}) {
            const vec3 place = triangle ? triangle_point(light, corner) : light.position;
            violations.place += length(place - node.centre) > node.radius * 1.00001f + 1e-6f;
        }
        violations.normal += triangle && is_outside_cone(node, light);
    }
    violations.intensity += std::abs(node.intensity - intensity) > 1e-4 * intensity;
    return below;
}

void expect_sound(const LitWorld& world) {
    Violations violations;
    std::vector<std::uint32_t> lights = check_node(world, 0, violations);
    EXPECT_EQ(violations.place, 0);
    EXPECT_EQ(violations.normal, 0);
    EXPECT_EQ(violations.intensity, 0);
    std::sort(lights.begin(), lights.end());
    EXPECT_EQ(std::adjacent_find(lights.begin(), lights.end()), lights.end()) << "a light is there twice";
    std::size_t members = 0;
    for (const std::uint32_t leaf : world.light_tree.leaves) members += leaf != INVALID_INDEX;
    EXPECT_EQ(lights.size(), members);
}

TEST(LightTree, EachNodeHoldsAllThatIsBelowIt) {
    for (const int count : {4, 8, 60, 1000}) expect_sound(build_random_world(std::uint64_t(count), count));
}

TEST(LightTree, TheTreeDoesNotDependOnThreads) {
    const LitWorld all = build_random_world(12, 6000);
    const tbb::global_control one_thread(tbb::global_control::max_allowed_parallelism, 1);
    EXPECT_EQ(build_random_world(12, 6000).light_tree.rows, all.light_tree.rows);
}

// Moves some nodes of the scene, which is then edited.
void move_some(LightScene& lights, Draws& draws) {
    for (Node& node : lights.scene().nodes) {
        if (draws.uniform() < 0.2) (*node.matrix)[3] += glm::dvec4(glm::dvec3(draws.unit_vector()), 0.0);
    }
    ++lights.scene().revision;
}

LightScene make_movable() {
    LightScene lights(13);
    for (int i = 0; i < 40; ++i) lights.add_triangles(20);
    for (int i = 0; i < 20; ++i) lights.add_punctual(i % 2 == 0 ? LightKind::POINT : LightKind::SPOT);
    return lights;
}

TEST(LightTree, AFittedTreeHoldsWhatMovedAndIsBuiltNoMore) {
    LightScene lights = make_movable();
    LitWorld world = build_lit_world(lights.scene());
    Draws draws(8);
    for (int step = 0; step < 10; ++step) {
        const LightTree before = world.light_tree;
        move_some(lights, draws);
        update_world(world, lights.scene(), -1.0);
        follow_lights(world);
        EXPECT_EQ(world.light_tree.structure_revision, before.structure_revision);
        EXPECT_EQ(world.light_tree.changes.revision(), before.changes.revision() + 1);
        EXPECT_EQ(world.light_tree.leaves, before.leaves);
        expect_sound(world);
        expect_sums_to_one(world);
        // The boxes, if not their order, are those of a tree built anew.
        const LitWorld fresh = build_lit_world(lights.scene());
        const vec3 shift = vec3(fresh.origin_ws - world.origin_ws);
        const LightBounds &fitted = world.light_tree.bounds[0], &built = fresh.light_tree.bounds[0];
        EXPECT_LT(length(fitted.lower - built.lower - shift), 1e-5f);
        EXPECT_LT(length(fitted.upper - built.upper - shift), 1e-5f);
    }
}

TEST(LightTree, OnlyTheRowsThatItNamesWereWritten) {
    LightScene lights = make_movable();
    LitWorld world = build_lit_world(lights.scene());
    std::vector<glm::uvec4> copy = world.light_tree.rows;
    ChangeLog::Cursor reader;
    EXPECT_TRUE(world.light_tree.changes.read(reader).everything);
    (*lights.scene().nodes[5].matrix)[3].y += 0.5;
    ++lights.scene().revision;
    update_world(world, lights.scene(), -1.0);
    follow_lights(world);
    std::size_t written = 0;
    for (const IndexRange& range : world.light_tree.changes.read(reader).ranges) {
        for (std::uint32_t row = range.first; row < range.last; ++row) copy[row] = world.light_tree.rows[row];
        written += range.last - range.first;
    }
    EXPECT_EQ(copy, world.light_tree.rows);
    EXPECT_GT(written, 0u);
    EXPECT_LT(written, world.light_tree.rows.size());
    follow_lights(world);
    EXPECT_FALSE(world.light_tree.changes.has_news(reader));
}

TEST(LightTree, UpdatesThatItMissedAreMadeUpFor) {
    LightScene lights = make_movable();
    LitWorld every = build_lit_world(lights.scene());
    LitWorld last = every;
    Draws draws(10);
    for (int step = 0; step < 3; ++step) {
        move_some(lights, draws);
        update_world(every, lights.scene(), -1.0);
        follow_lights(every);
        update_world(last, lights.scene(), -1.0);
    }
    follow_lights(last);
    EXPECT_EQ(last.light_tree.rows, every.light_tree.rows);
}

TEST(LightTree, ItIsBuiltAnewWhereLightsComeAndGo) {
    LightScene lights = make_movable();
    LitWorld world = build_lit_world(lights.scene());
    const std::uint64_t before = world.light_tree.structure_revision;
    lights.scene().light_nodes.erase(lights.scene().light_nodes.begin() + 3);
    ++lights.scene().revision;
    update_world(world, lights.scene(), -1.0);
    follow_lights(world);
    EXPECT_EQ(world.light_tree.structure_revision, before + 1);
    expect_sound(world);
    expect_sums_to_one(world);
    lights.scene().lights[5].kind = LightKind::DIRECTIONAL;  // the same light leaves the tree
    ++lights.scene().revision;
    update_world(world, lights.scene(), -1.0);
    follow_lights(world);
    expect_sound(world);
    expect_sums_to_one(world);
}

}  // namespace
}  // namespace tarn
