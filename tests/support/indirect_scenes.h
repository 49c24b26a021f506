// Rooms that are lit indirectly while something in them moves. The lamp shines at the ceiling: what the
// camera sees of the walls and the floor has come by way of other surfaces, and any fault of path samples
// shows.
#pragma once

#include "support/moving_scenes.h"

namespace tarn::test {

// Half the edges of the lamp and of what may come before it, metres.
constexpr float LAMP_HALF_M = 0.25f;
constexpr float BLIND_HALF_M = 0.45f;

// Where the lamp hangs.
inline glm::dvec3 lamp_place_ws() {
    return {0.0, 1.2, -0.3};
}

// A hanging quad whose front looks up.
inline glm::dmat4 face_up(const glm::dvec3& position, double scale = 1.0, double turn_rad = 0.0) {
    return place_at(position, {scale, -1.0, scale}, turn_rad);
}

// Floor, three walls, and a ceiling unless the room is open to the sky.
inline ToyScene make_room(bool has_ceiling = true) {
    ToyScene toy;
    const auto paint = [&](float r, float g, float b) {
        return toy.add_material(lambert_material(glm::vec3(r, g, b)));
    };
    toy.add_quad(paint(0.7f, 0.65f, 0.6f), {-1.5f, 0, 2}, {3, 0, 0}, {0, 0, -3.5f});
    toy.add_quad(paint(0.6f, 0.7f, 0.7f), {-1.5f, 0, -1.5f}, {3, 0, 0}, {0, 2.4f, 0});
    toy.add_quad(paint(0.7f, 0.4f, 0.3f), {-1.5f, 0, 2}, {0, 0, -3.5f}, {0, 2.4f, 0});
    toy.add_quad(paint(0.3f, 0.6f, 0.4f), {1.5f, 0, -1.5f}, {0, 0, 3.5f}, {0, 2.4f, 0});
    if (has_ceiling) toy.add_quad(paint(0.8f, 0.8f, 0.8f), {-1.5f, 2.4f, -1.5f}, {3, 0, 0}, {0, 0, 3.5f});
    return toy;
}

inline NodeIndex add_uplight(ToyScene& toy, const glm::vec3& radiance = {60.0f, 50.0f, 40.0f}) {
    toy.add_instance(add_hanging_quad(toy, emissive_material(radiance), LAMP_HALF_M),
                     face_up(lamp_place_ws()));
    return last_node(toy);
}

inline NodeIndex add_blind(ToyScene& toy) {
    Material dark = lambert_material(glm::vec3(0.1f));
    dark.double_sided = true;
    toy.add_instance(add_hanging_quad(toy, dark, BLIND_HALF_M));
    return last_node(toy);
}

inline MovingScene view_room(ToyScene toy) {
    MovingScene moving;
    moving.scene = std::move(toy.scene);
    moving.camera_ws = {0.0, 0.9, 1.9};
    moving.target_ws = {0.0, 0.6, -0.6};
    return moving;
}

// A wide lamp close under the ceiling, and small ones that shine at it too: what the camera sees is lit by
// places that have one lamp in much of their view and are lit by the others as well. Nothing moves.
inline MovingScene make_lamps_close_to_the_ceiling() {
    ToyScene toy = make_room();
    toy.add_instance(add_hanging_quad(toy, emissive_material({8.0f, 7.0f, 6.0f}), 0.6f),
                     face_up({0.2, 2.1, -0.2}));
    const MeshIndex small = add_hanging_quad(toy, emissive_material({40.0f, 40.0f, 50.0f}), 0.1f);
    for (const double x : {-1.2, -0.8, 1.1}) toy.add_instance(small, face_up({x, 1.6, 0.3 * x}));
    MovingScene still = view_room(std::move(toy));
    still.pose = [](Scene&, int) {};
    return still;
}

// The lamp grows (or shrinks) by `rate` a frame, turns and drifts.
inline MovingScene make_breathing_uplight(double rate) {
    ToyScene toy = make_room();
    const NodeIndex lamp = add_uplight(toy);
    MovingScene moving = view_room(std::move(toy));
    moving.pose = [=](Scene& scene, int frame) {
        const int left = frame - LAST_FRAME;
        const glm::dvec3 drift(0.02 * left, 0.0, -0.02 * left);
        put(scene, lamp, face_up(lamp_place_ws() + drift, std::pow(1.0 + rate, left), 0.05 * left));
    };
    return moving;
}

// A reflector of rough metal over the lamp that grows by `rate` a frame, turns by `turn_rad` and drifts; its
// normals are those of a dish. What it throws down is most of the light.
inline MovingScene make_moving_reflector(double rate, double turn_rad) {
    ToyScene toy = make_room(false);
    add_uplight(toy);
    Material metal = glossy_material(glm::vec3(0.8f), 0.5f);
    metal.metallic = 1.0f;
    toy.add_instance(add_hanging_quad(toy, metal, 1.0f));
    const NodeIndex reflector = last_node(toy);
    Mesh& dish = toy.scene.meshes.back();
    for (std::size_t i = 0; i < dish.normals_os.size(); ++i) {
        dish.normals_os[i] = glm::normalize(dish.normals_os[i] - 0.3f * dish.positions_os[i]);
    }
    MovingScene moving = view_room(std::move(toy));
    moving.pose = [=](Scene& scene, int frame) {
        const int left = frame - LAST_FRAME;
        const glm::dmat4 tilt =
            glm::rotate(glm::dmat4(1.0), 0.4 + turn_rad * left, glm::dvec3(1.0, 0.1, 0.6));
        const glm::dmat4 place = glm::translate(
            glm::dmat4(1.0), lamp_place_ws() + glm::dvec3(0.01 * left, 0.7 + 0.01 * left, 0.0));
        put(scene, reflector,
            place * tilt * glm::scale(glm::dmat4(1.0), glm::dvec3(std::pow(1.0 + rate, left))));
    };
    return moving;
}

// A blind slides by `step_m` a frame between the lamp and the ceiling, or between the sky and the room; in
// the last frame it covers half. Positive: it comes, negative: it goes.
inline MovingScene make_sliding_blind(double step_m, bool under_a_sky = false) {
    ToyScene toy = make_room(!under_a_sky);
    if (!under_a_sky) add_uplight(toy);
    const NodeIndex blind = add_blind(toy);
    MovingScene moving = view_room(std::move(toy));
    if (under_a_sky) moving.options = even_sky(glm::vec3(0.8f, 0.9f, 1.2f));
    const double size = under_a_sky ? 4.0 : 1.0;
    const glm::dvec3 place =
        under_a_sky ? glm::dvec3(0.0, 2.5, 0.0) : lamp_place_ws() + glm::dvec3(0, 0.1, 0);
    moving.pose = [=](Scene& scene, int frame) {
        const double away_m = BLIND_HALF_M * size - step_m * (frame - LAST_FRAME);
        put(scene, blind, place_at(place + glm::dvec3(away_m, 0.0, 0.0), glm::dvec3(size)));
    };
    return moving;
}

// All of it at once: lamp, reflector and blind move.
inline MovingScene make_restless_room() {
    ToyScene toy = make_room();
    const NodeIndex lamp = add_uplight(toy);
    const NodeIndex blind = add_blind(toy);
    const NodeIndex ball = add_ball(toy, lambert_material(glm::vec3(0.8f, 0.7f, 0.5f)), 0.3f);
    MovingScene moving = view_room(std::move(toy));
    moving.pose = [=](Scene& scene, int frame) {
        const int left = frame - LAST_FRAME;
        put(scene, lamp, face_up(lamp_place_ws() + glm::dvec3(0.02 * left, 0, 0), std::pow(1.03, left)));
        put(scene, blind, place_at(lamp_place_ws() + glm::dvec3(0.3 - 0.05 * left, 0.15, 0.1)));
        put(scene, ball, place_at({0.5 + 0.02 * left, 0.3, -0.5}, glm::dvec3(1.0), 0.1 * left));
    };
    return moving;
}

}  // namespace tarn::test
