// Leads a person through a level by its inputs alone, as somebody who knows the way would.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "game/play/simulation.h"

namespace tarn::test {

class Guide {
  public:
    explicit Guide(game::Simulation& simulation) : simulation_(simulation) {}

    // Goes to a place on the floor; false where it has not come there within `most` steps.
    bool walk_to(double x, double z, bool run = false, int most = 900) {
        for (int i = 0; i < most; ++i) {
            const game::PlayerState& player = simulation_.state().player;
            if (std::hypot(x - player.feet.x, z - player.feet.z) < 0.25) return true;
            game::StepInput input = turn_to({x, player.eye().y, z});
            if (std::abs(input.look_right) < 100) input.forward = game::FULL_SPEED;
            input.run = run;
            step(input);
        }
        return false;
    }
    // Turns the head until a place is in the middle of the view.
    void look_at(const game::Vec3& place) {
        for (int i = 0; i < 60; ++i) step(turn_to(place));
    }
    void step(const game::StepInput& input) {
        steps_.push_back(input);
        simulation_.step(input);
    }
    const std::vector<game::StepInput>& steps() const { return steps_; }

  private:
    game::StepInput turn_to(const game::Vec3& place) const {
        constexpr double RAD_PER_PX = 0.0022, HALF_TURN_RAD = 3.14159265358979;
        constexpr int MOST_PX = 120;
        const game::PlayerState& player = simulation_.state().player;
        const game::Vec3 eye = player.eye();
        const double x = place.x - eye.x, y = place.y - eye.y, z = place.z - eye.z;
        const double turn = std::remainder(std::atan2(-x, -z) - player.yaw_rad, 2.0 * HALF_TURN_RAD);
        const double tilt = std::atan2(y, std::hypot(x, z)) - player.pitch_rad;
        game::StepInput input;
        input.look_right = std::clamp(int(std::lround(-turn / RAD_PER_PX)), -MOST_PX, MOST_PX);
        input.look_down = std::clamp(int(std::lround(-tilt / RAD_PER_PX)), -MOST_PX, MOST_PX);
        return input;
    }

    game::Simulation& simulation_;
    std::vector<game::StepInput> steps_;
};

// From the start of lantern_court across the court, up its stair and onto the gallery, to a dead lantern
// there.
inline bool climb_to_the_gallery(Guide& guide) {
    constexpr double STAIR_X = -13.76;
    return guide.walk_to(6.0, 4.6, true) && guide.walk_to(0.0, 5.0, true) && guide.walk_to(-4.0, 3.6, true) &&
           guide.walk_to(-9.5, 5.0, true) && guide.walk_to(-11.8, 8.4) && guide.walk_to(STAIR_X, 8.4) &&
           guide.walk_to(STAIR_X, 6.5) && guide.walk_to(STAIR_X, -0.7) && guide.walk_to(-15.4, -0.7);
}

}  // namespace tarn::test
