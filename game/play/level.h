// What the simulation knows of a scene: what is solid, where play starts, which lanterns there are.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "../tarn_names.h"

namespace game {

// A small lamp that stands still.
struct Lantern {
    Node node;
    Vec3 position;         // its middle, world space
    bool is_dead = false;  // until somebody lights it
};

// A wooden crate's place: its middle before it is dropped, world space, and its turn about the vertical.
struct CratePlace {
    Vec3 above;
    double yaw_rad = 0.0;
};

struct Level {
    // Solid triangles: nine numbers each, metres relative to `origin`.
    std::vector<std::array<float, 9>> triangles;
    Vec3 origin;  // world space; near the triangles, so that single precision keeps its digits
    Box bounds;   // of the triangles, world space; empty without triangles
    // Where the eye starts; it is dropped to the floor, and where there is none below it the level gets one.
    // Yaw and pitch as in FlyCamera.
    Vec3 start_eye;
    double start_yaw_rad = 0.0;
    double start_pitch_rad = 0.0;
    double half_height = 0.5;  // of the camera's image plane at 1 m
    std::vector<Lantern> lanterns;
    std::vector<CratePlace> crates;  // wished for: those without room there are left out
    int fireflies = 0;               // wished for, as well
};

// Solid is what no animation moves and no texture cuts holes into, as into leaves. Play starts at the scene's
// first camera. Every third of the lanterns that stand still is dead.
// Fireflies are in lantern_court alone, unless somebody wishes for some.
Level make_level(const Scene& scene);

// Of the solid triangles, the start and the crates: replays name the level that they were recorded in by it.
std::uint64_t compute_hash(const Level& level);

}  // namespace game
