// Small scenes in which something changes every frame: what lights, what is lit, what stands between.
//
// Each is a function of the frame number, so that every seed sees the same motion and arrives at the same last
// frame, for which there is one reference. The floor fills the picture: no part of it is dark.
#pragma once

#include <cmath>
#include <functional>
#include <glm/gtc/matrix_transform.hpp>
#include <string>

#include "support/toy_scenes.h"

namespace tarn::test {

// The frame that is compared; motion passes through its place there.
constexpr int LAST_FRAME = 9;

struct MovingScene {
    Scene scene;
    std::function<void(Scene&, int frame)> pose;  // puts everything where it is in that frame
    WorldOptions options;
    glm::dvec3 camera_ws{0.0, 2.6, 2.9};
    glm::dvec3 target_ws{0.0, 0.0, 0.1};
};

inline NodeIndex last_node(const ToyScene& toy) {
    return NodeIndex(toy.scene.nodes.size() - 1);
}

inline void place(Scene& scene, NodeIndex node, const glm::dvec3& position, double scale = 1.0,
                  double turn_rad = 0.0) {
    glm::dmat4 m = glm::translate(glm::dmat4(1.0), position);
    m = glm::rotate(m, turn_rad, glm::dvec3(0.3, 1.0, 0.2));
    at(scene.nodes, node).matrix = glm::scale(m, glm::dvec3(scale));
    ++scene.revision;
}

inline Material glossy_material(const glm::vec3& albedo, float roughness) {
    Material m = lambert_material(albedo);
    m.roughness = roughness;
    m.specular = 1.0f;
    return m;
}

// A floor under a wide, dim lamp that lights all of it.
inline ToyScene make_lit_floor(const Material& material = lambert_material(glm::vec3(0.7f, 0.6f, 0.5f))) {
    ToyScene toy;
    toy.add_quad(toy.add_material(material), {-6, 0, 6}, {12, 0, 0}, {0, 0, -12});
    toy.add_quad(toy.add_material(emissive_material(glm::vec3(1.0f, 1.2f, 1.5f))), {-1.5f, 4, -1.5f}, {3, 0, 0},
                 {0, 0, 3});
    return toy;
}

inline NodeIndex add_ball(ToyScene& toy, const Material& material, float radius) {
    toy.add_instance(toy.add_mesh(toy.add_material(material), sphere_corners(radius, 4)));
    return last_node(toy);
}

// A glowing ball, a ball that it lights and one that stands in its light, all moving by `step_m` a frame.
inline MovingScene make_moving_things(double step_m) {
    ToyScene toy = make_lit_floor();
    const NodeIndex lamp = add_ball(toy, emissive_material(glm::vec3(9.0f, 6.0f, 3.0f)), 0.25f);
    const NodeIndex lit = add_ball(toy, lambert_material(glm::vec3(0.8f)), 0.35f);
    const NodeIndex blocker = add_ball(toy, lambert_material(glm::vec3(0.3f, 0.5f, 0.7f)), 0.2f);
    MovingScene moving;
    moving.scene = std::move(toy.scene);
    moving.pose = [=](Scene& scene, int frame) {
        const double way_m = step_m * (frame - LAST_FRAME);
        place(scene, lamp, {way_m, 0.5, -0.2});
        place(scene, lit, {-1.0, 0.35, 0.2 + way_m});
        place(scene, blocker, {0.6 - 0.7 * way_m, 0.25, 0.4 + 0.7 * way_m});
    };
    return moving;
}

}  // namespace tarn::test
