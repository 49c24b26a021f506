// A gamepad, by GLFW's mapping of the many kinds there are.
#pragma once

#include "vectors.h"

namespace game {

// What is held on it at a moment.
struct PadState {
    bool is_there = false;
    Vec2 left_stick;  // -1 to 1, right and down, as the device says: never quite 0
    Vec2 right_stick;
    double left_trigger = 0.0;  // 0 to 1
    double right_trigger = 0.0;
    bool a = false;
    bool b = false;
    bool x = false;
    bool start = false;
};

// Of the first gamepad that GLFW knows; one without any where there is none, or where it has been pulled out.
PadState read_gamepad();

// A stick as a hand means it: 0 in the middle, where no stick rests exactly, 1 long before the rim, which not
// every stick reaches, and in between slow at first. Its direction stays.
Vec2 shape_stick(const Vec2& raw);

}  // namespace game
