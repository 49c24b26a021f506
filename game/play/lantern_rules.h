// Relight the court: which lantern is looked at, and what a hand does to it.
#pragma once

#include <vector>

#include "simulation.h"

namespace game {

class LanternRules {
  public:
    explicit LanternRules(const std::vector<Lantern>& lanterns) : lanterns_(lanterns) {}

    // All as in the level.
    void restart(PlayState& state) const;
    // After the player has moved. `ahead`: where it looks, 1 long. E lights the lantern that is looked at, or
    // puts it out; the wheel changes its colour, with run held its brightness; without a lantern the wheel
    // chooses the colour of the next ball.
    void step(const StepInput& input, const Vec3& ahead, PlayState& state) const;

    static constexpr double REACH_M = 3.0;  // from the eye

    // Counts the dead lanterns and those of them that are lit.
    void count(PlayState& state) const;

  private:
    int find_aimed(const Vec3& eye, const Vec3& ahead) const;

    std::vector<Lantern> lanterns_;
};

}  // namespace game
