// The scene's part in the play: balls, crates, lanterns, fireflies and a torch, as the simulation says where
// and how bright they are.
#pragma once

#include <vector>

#include "../play/level.h"
#include "../play/simulation.h"
#include "firefly_lamps.h"

namespace game {

class Actors {
  public:
    // Adds all balls, dark and out of sight, crates and fireflies of the first state, and gives each lantern
    // materials of its own: before the first frame, since views begin anew after it. The scene must outlive
    // this.
    Actors(Scene& scene, const Level& level, const PlayState& start);

    // Moves and switches what differs from the last call. Of the fireflies the first `lit_fireflies` shine.
    void show(const PlayState& state, int lit_fireflies);

  private:
    struct Ball {
        Node node;
        std::size_t material = 0;
        Transform parked;
        BallState shown;
    };
    struct Crate {
        Node node;
        CrateState shown;
    };
    struct LanternPart {
        std::size_t material = 0;
        Surface surface;  // as the scene has it
    };
    struct LanternActor {
        std::vector<LanternPart> parts;  // those that shine
        LanternState shown;
    };

    void show_ball(Ball& ball, const BallState& state);
    void show_torch(const TorchState& state);
    void show_crate(Crate& crate, const CrateState& state);
    void show_lantern(LanternActor& lantern, const LanternState& state);

    Scene& scene_;
    std::vector<Ball> balls_;
    std::vector<Crate> crates_;
    std::vector<LanternActor> lanterns_;
    Node torch_;
    TorchState torch_shown_;
    FireflyLamps fireflies_;
};

}  // namespace game
