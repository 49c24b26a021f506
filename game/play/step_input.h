// What a person asks for during one step of the simulation. Whole numbers, so that a file keeps all of it.
#pragma once

namespace game {

inline constexpr int FULL_SPEED = 100;

struct StepInput {
    int right = 0;  // -FULL_SPEED to FULL_SPEED: a stick may ask for less
    int forward = 0;
    bool run = false;
    bool crouch = false;
    bool jump = false;  // this and the next ones: went down since the last step
    bool throw_ball = false;
    bool use = false;    // light or put out the lantern that is looked at
    bool torch = false;  // take it out or put it away
    bool restart = false;
    int look_right = 0;  // mouse movement, pixels
    int look_down = 0;
    int wheel = 0;  // steps; positive: away from the hand

    bool operator==(const StepInput&) const = default;
};

}  // namespace game
