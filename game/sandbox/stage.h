// A scene that is played in: what the window, replays and tests have in common.
#pragma once

#include <cstdint>
#include <optional>

#include "../play/simulation.h"
#include "../play/snapshot.h"
#include "actors.h"

namespace game {

// How the stage is drawn.
struct StageLook {
    Settings settings;
    std::uint32_t seed = 0;
    double glare_strength = 1.0;
};

class Stage {
  public:
    // Adds what play needs to the scene; views come later. `fireflies`: how many are wished for; nullopt: as
    // many as the level has.
    explicit Stage(Scene scene, std::optional<int> fireflies = std::nullopt);
    // Actors hold the scene.
    Stage(const Stage&) = delete;
    Stage& operator=(const Stage&) = delete;

    // Goes on by one step.
    void step(const StepInput& input) { simulation_.step(input); }
    SavedPlay save() const { return simulation_.save(); }
    // As for Simulation.
    void load(const SavedPlay& saved) { simulation_.load(saved); }
    // Brings the scene to where the simulation is.
    void show();
    // How many of the fireflies shine, from the next show() on; all of them unless said.
    void set_lit_fireflies(int count) { lit_fireflies_ = count; }
    // What the player sees, as frame `number` of a view, `elapsed_s` after the one before.
    Frame make_frame(const StageLook& look, std::uint32_t number, double elapsed_s) const;

    const Scene& scene() const { return scene_; }
    const PlayState& state() const { return simulation_.state(); }
    std::uint64_t level_hash() const { return level_hash_; }
    int wished_fireflies() const { return level_.fireflies; }
    std::size_t solid_triangles() const { return level_.triangles.size(); }

  private:
    Scene scene_;
    Level level_;
    std::uint64_t level_hash_;
    Simulation simulation_;
    Actors actors_;
    bool is_animated_;
    int lit_fireflies_ = FIREFLY_LIMIT;
};

}  // namespace game
