// A scene whose lights can be moved and edited, and what must hold of the table of lights after each update.
#pragma once

#include <gtest/gtest.h>

#include "support/toy_scenes.h"
#include "world/world.h"

namespace tarn::test {

inline constexpr int LAMP_COUNT = 12;
inline constexpr std::uint32_t LAMP_TRIANGLES = 2;

inline Transform place(double x, double y, double z) {
    Transform transform;
    transform.translation = {x, y, z};
    return transform;
}

// A floor that keeps the bounds, LAMP_COUNT emissive quads above it and three punctual lights, all on nodes
// that can be moved.
class MovableScene {
  public:
    MovableScene() {
        const MaterialIndex grey = toy_.add_material(lambert_material(glm::vec3(0.5f)));
        toy_.add_quad(grey, {-50, 0, 50}, {100, 0, 0}, {0, 0, -100});
        toy_.add_quad(grey, {-50, 30, 50}, {100, 0, 0}, {0, 0, -100});
        for (int i = 0; i < LAMP_COUNT; ++i) {
            lamp_material = toy_.add_material(emissive_material(glm::vec3(1.0f + float(i))));
            toy_.add_quad(lamp_material, {0, 0, 0}, {1, 0, 0}, {0, 0, 0.5f});
            lamp_nodes.push_back(toy_.scene.instances.back().node);
            free_node(lamp_nodes.back(), place(3.0 * i, 5.0, -1.0));
        }
        for (int i = 0; i < 3; ++i) add_point(float(10 + i));
    }

    Scene& scene() { return toy_.scene; }
    Node& node(NodeIndex index) { return at(toy_.scene.nodes, index); }

    NodeIndex add_point(float intensity) {
        PunctualLight light;
        light.intensity = glm::vec3(intensity);
        toy_.add_light(light, glm::dmat4(1.0));
        const NodeIndex index = scene().light_nodes.back();
        free_node(index, place(intensity, 3.0, 0.0));
        return index;
    }

    // Turns the node's matrix into a transform that can be set and animated.
    void free_node(NodeIndex index, const Transform& local) {
        node(index).matrix.reset();
        node(index).local = local;
    }

    void update(World& world) {
        ++scene().revision;
        update_world(world, scene(), -1.0);
    }

    std::vector<NodeIndex> lamp_nodes;
    MaterialIndex lamp_material;  // of the last lamp

  private:
    ToyScene toy_;
};

// The table equals that of a world built anew from the scene as it is: rows and places to the bit, powers up
// to their tolerance.
inline void expect_as_built(const World& world, const Scene& scene, double time_s = -1.0) {
    WorldOptions options;
    options.time_s = time_s;
    const World fresh = build_world(scene, options);
    ASSERT_EQ(world.origin_ws, fresh.origin_ws) << "the test must keep the bounds";
    EXPECT_EQ(world.lights.count, fresh.lights.count);
    EXPECT_EQ(world.lights.punctual_count, fresh.lights.punctual_count);
    EXPECT_EQ(world.lights.rows, fresh.lights.rows);
    EXPECT_EQ(world.lights.identities, fresh.lights.identities);
    EXPECT_EQ(world.lights.instance_first, fresh.lights.instance_first);
    EXPECT_EQ(world.lights.light_of_primitive, fresh.lights.light_of_primitive);
    ASSERT_EQ(world.lights.pmf.size(), fresh.lights.pmf.size());
    for (std::size_t i = 0; i < fresh.lights.pmf.size(); ++i) {
        EXPECT_NEAR(world.lights.pmf[i], fresh.lights.pmf[i], 2.0 * POWER_TOLERANCE * fresh.lights.pmf[i]);
    }
}

}  // namespace tarn::test
