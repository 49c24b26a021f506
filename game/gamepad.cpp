#include "gamepad.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <algorithm>
#include <cmath>

namespace game {
namespace {

constexpr double DEAD_ZONE = 0.18;
constexpr double RIM = 0.95;
constexpr double CURVE = 1.7;  // an exponent: above 1, small movements are finer

double to_unit(float trigger) {
    return 0.5 * (double(trigger) + 1.0);
}

}  // namespace

PadState read_gamepad() {
    for (int id = GLFW_JOYSTICK_1; id <= GLFW_JOYSTICK_LAST; ++id) {
        GLFWgamepadstate raw;
        if (glfwJoystickIsGamepad(id) != GLFW_TRUE || glfwGetGamepadState(id, &raw) != GLFW_TRUE) continue;
        const auto is_down = [&](int button) { return raw.buttons[button] == GLFW_PRESS; };
        PadState pad;
        pad.is_there = true;
        pad.left_stick = {raw.axes[GLFW_GAMEPAD_AXIS_LEFT_X], raw.axes[GLFW_GAMEPAD_AXIS_LEFT_Y]};
        pad.right_stick = {raw.axes[GLFW_GAMEPAD_AXIS_RIGHT_X], raw.axes[GLFW_GAMEPAD_AXIS_RIGHT_Y]};
        pad.left_trigger = to_unit(raw.axes[GLFW_GAMEPAD_AXIS_LEFT_TRIGGER]);
        pad.right_trigger = to_unit(raw.axes[GLFW_GAMEPAD_AXIS_RIGHT_TRIGGER]);
        pad.a = is_down(GLFW_GAMEPAD_BUTTON_A);
        pad.b = is_down(GLFW_GAMEPAD_BUTTON_B);
        pad.x = is_down(GLFW_GAMEPAD_BUTTON_X);
        pad.start = is_down(GLFW_GAMEPAD_BUTTON_START);
        return pad;
    }
    return {};
}

Vec2 shape_stick(const Vec2& raw) {
    const double way = std::hypot(raw.x, raw.y);
    if (!(way > DEAD_ZONE)) return {};
    const double share = std::min((way - DEAD_ZONE) / (RIM - DEAD_ZONE), 1.0);
    const double factor = std::pow(share, CURVE) / way;
    return {raw.x * factor, raw.y * factor};
}

}  // namespace game
