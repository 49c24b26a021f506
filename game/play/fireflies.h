// Fireflies: where each of them is and how bright, as a function of the step. Each wanders about a place in
// the open air, and cannot leave it.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "physics.h"
#include "simulation.h"

namespace game {

class Fireflies {
  public:
    // Looks for places that somebody who starts in the level sees, around corners too: between them and the
    // start nothing solid is in the way. There are fewer than `count` where the level has no room. The places
    // of fewer are the first ones of more.
    Fireflies(const Physics& physics, const Level& level, int count);

    // All of them at a step since the start.
    void describe(std::uint64_t step, std::vector<FireflyState>& fireflies) const;

    static constexpr double WANDER_M = 0.7;  // the farthest from its place

  private:
    struct Swing {
        double rad_per_step = 0.0;
        double phase_rad = 0.0;
    };
    struct Firefly {
        Vec3 place;                                // world space
        std::array<std::array<Swing, 2>, 3> ways;  // a slow and a quick one along each axis
        Swing blink;
    };

    static Firefly make(const Vec3& place, std::uint64_t index);

    std::vector<Firefly> fireflies_;
};

}  // namespace game
