// The sandbox's world as plain numbers: all that play needs to go on from there. Positions are relative to
// the level's origin, metres.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "simulation.h"

namespace game {

struct BodySnapshot {
    std::array<float, 9> turn{};  // a matrix, row by row: a quaternion would not give the same bits back
    std::array<float, 3> middle{};
    std::array<float, 3> velocity{};  // m/s
    std::array<float, 3> spin{};      // rad/s
    int activation = 1;               // Bullet's state: awake, asleep and so on
    float still_s = 0.0f;             // for how long it has hardly moved

    bool operator==(const BodySnapshot&) const = default;
};

struct BallSnapshot {
    bool is_alive = false;
    int color = 0;
    BodySnapshot body;

    bool operator==(const BallSnapshot&) const = default;
};

struct CharacterSnapshot {
    std::array<float, 3> middle{};
    std::array<float, 3> velocity{};  // m/s, along the floor
    std::array<float, 3> wish{};      // m/s
    float eye_height_m = 0.0f;
    float rise_m_s = 0.0f;
    float rise_m = 0.0f;  // of the last step
    bool is_crouching = false;
    bool was_on_ground = false;
    bool was_jumping = false;

    bool operator==(const CharacterSnapshot&) const = default;
};

struct Snapshot {
    std::uint64_t step = 0;
    double yaw_rad = 0.0;
    double pitch_rad = 0.0;
    int aimed_lantern = -1;
    int next_color = 0;
    std::uint64_t finished_step = 0;
    bool torch = false;
    CharacterSnapshot character;
    std::vector<BallSnapshot> balls;  // BALL_LIMIT
    int next_ball = 0;                // whose turn is next
    std::vector<BodySnapshot> crates;
    std::vector<LanternState> lanterns;

    bool operator==(const Snapshot&) const = default;
};

// A moment of play: a snapshot, and what was done since.
struct SavedPlay {
    Snapshot snapshot;
    std::vector<StepInput> since;  // fewer than SNAPSHOT_STEPS, no restarts

    bool operator==(const SavedPlay&) const = default;
};

}  // namespace game
