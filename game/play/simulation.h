// The sandbox's world: a person who walks, glowing balls, crates, lanterns, fireflies. Its state is a
// function of the level and of the inputs so far, to the bit.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "level.h"
#include "step_input.h"

namespace game {

inline constexpr int STEPS_PER_S = 60;
inline constexpr double STEP_S = 1.0 / STEPS_PER_S;
inline constexpr int BALL_LIMIT = 50;  // a further one takes the place of the oldest
inline constexpr double BALL_RADIUS_M = 0.15;
inline constexpr double CRATE_HALF_M = 0.3;  // of their edge
inline constexpr int PLAY_COLORS = 8;        // of balls and lanterns
inline constexpr int FIREFLY_LIMIT = 1000;
// Every so many steps all bodies are made anew from a snapshot, in every run, so that nothing which a
// snapshot does not hold, such as Bullet's contacts, outlives it: a save is the last snapshot and the inputs
// since.
inline constexpr int SNAPSHOT_STEPS = 600;

struct PlayerState {
    Vec3 feet;  // world space, metres
    double eye_height_m = 0.0;
    double yaw_rad = 0.0;  // as in FlyCamera
    double pitch_rad = 0.0;
    bool is_on_ground = false;
    bool is_crouching = false;

    Vec3 eye() const { return {feet.x, feet.y + eye_height_m, feet.z}; }
};

struct BallState {
    bool is_alive = false;
    Vec3 position;  // world space, metres
    Rotation rotation;
    Vec3 velocity;  // m/s
    int color = 0;  // below PLAY_COLORS
};

struct CrateState {
    Vec3 position;  // its middle, world space, metres
    Rotation rotation;
    Vec3 velocity;  // m/s
};

struct LanternState {
    bool is_lit = true;
    int color = -1;           // below PLAY_COLORS; -1: the scene's own
    double brightness = 1.0;  // relative to the scene's own

    bool operator==(const LanternState&) const = default;
};

struct TorchState {
    bool is_lit = false;
    Vec3 position;            // of its flame, world space, metres
    double brightness = 0.0;  // relative to its mean; 0: not lit
};

struct FireflyState {
    Vec3 position;            // world space, metres
    double brightness = 0.0;  // relative to its brightest; above 0
};

struct PlayState {
    std::uint64_t step = 0;  // since the start, or since the last restart
    PlayerState player;
    std::vector<BallState> balls;        // BALL_LIMIT
    std::vector<CrateState> crates;      // always as many
    std::vector<LanternState> lanterns;  // as in the level
    TorchState torch;
    std::vector<FireflyState> fireflies;  // always as many
    int aimed_lantern = -1;               // within reach, in the middle of the view; -1: none
    int next_color = 0;                   // of the next ball
    int dead_count = 0;                   // lanterns that were dead
    int relit_count = 0;                  // and are lit now
    std::uint64_t finished_step = 0;      // when all were lit for the first time; 0: not yet
};

struct SavedPlay;

// Of every number in it.
std::uint64_t compute_hash(const PlayState& state);

class Simulation {
  public:
    // Keeps a copy of what it needs of the level.
    explicit Simulation(const Level& level);
    ~Simulation();
    Simulation(const Simulation&) = delete;
    Simulation& operator=(const Simulation&) = delete;

    // Goes on by STEP_S seconds.
    void step(const StepInput& input);

    const PlayState& state() const;

    // What load() needs to be in this state again, and to go on from it with the same bits.
    SavedPlay save() const;
    // Error where it is of a level with other lanterns or crates; then all stays as it is.
    void load(const SavedPlay& saved);

  private:
    struct Parts;
    std::unique_ptr<Parts> parts_;
};

}  // namespace game
