#include "controls.h"

#include <algorithm>
#include <cmath>

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

namespace game {
namespace {

constexpr int UNSETTLED_LOOKS = 3;
constexpr double PAD_LOOK_PX_S = 1000.0;  // as of a mouse: 2.2 rad/s
constexpr double LONGEST_LOOK_S = 0.1;    // a slow frame must not whirl the head around
constexpr double PULLED = 0.5;            // of a trigger's way

// The whole part; what is left waits for the next call.
int take_whole(double& value) {
    const double whole = std::trunc(value);
    value -= whole;
    return int(whole);
}

}  // namespace

void ControlReader::capture_mouse(bool captured) {
    if (captured && !has_mouse_) unsettled_looks_ = UNSETTLED_LOOKS;
    has_mouse_ = captured;
    input_.capture_mouse(captured);
}

bool ControlReader::is_held(Action action) const {
    const std::vector<int>& keys = keys_.keys(action);
    return std::any_of(keys.begin(), keys.end(), [&](int key) { return input_.is_held(key); });
}

bool ControlReader::was_pressed(Action action) const {
    const std::vector<int>& keys = keys_.keys(action);
    return std::any_of(keys.begin(), keys.end(), [&](int key) { return input_.was_pressed(key); });
}

void ControlReader::read_play(StepInput& play, const PadState& pad, double dt_s) {
    const auto axis = [&](Action positive, Action negative) {
        return FULL_SPEED * (int(is_held(positive)) - int(is_held(negative)));
    };
    play.right = axis(Action::RIGHT, Action::LEFT);
    play.forward = axis(Action::FORWARD, Action::BACK);
    play.run = is_held(Action::RUN);
    play.crouch = is_held(Action::CROUCH);
    play.jump = was_pressed(Action::JUMP);
    play.throw_ball = input_.was_clicked(GLFW_MOUSE_BUTTON_LEFT);
    play.use = was_pressed(Action::USE);
    play.torch = was_pressed(Action::TORCH);
    play.restart = was_pressed(Action::RESTART);
    add_pad(pad, pad_, play);
    Vec2 way = input_.take_mouse_way();
    if (unsettled_looks_ > 0) {
        --unsettled_looks_;
        way = {};
    }
    const Vec2 stick = shape_stick(pad.right_stick);
    const double stick_px = PAD_LOOK_PX_S * std::min(dt_s, LONGEST_LOOK_S);
    rest_px_ = {rest_px_.x + way.x + stick_px * stick.x, rest_px_.y + way.y + stick_px * stick.y};
    rest_steps_ += input_.wheel_steps();
    play.look_right = take_whole(rest_px_.x);
    play.look_down = take_whole(rest_px_.y);
    play.wheel = take_whole(rest_steps_);
}

Controls ControlReader::read(double dt_s) {
    Controls controls;
    const PadState pad = read_gamepad();
    controls.pause = pad_.is_there && pad.start && !pad_.start;
    controls.leave = input_.was_pressed(GLFW_KEY_ESCAPE);
    controls.help = was_pressed(Action::HELP);
    controls.panel = was_pressed(Action::PANEL);
    controls.save = was_pressed(Action::SAVE);
    controls.load = was_pressed(Action::LOAD);
    controls.fullscreen = was_pressed(Action::FULLSCREEN);
    const std::vector<int>& keys = keys_.keys(Action::SCREENSHOT);
    controls.radiance =
        std::any_of(keys.begin(), keys.end(), [&](int key) { return input_.was_pressed_with_shift(key); });
    controls.screenshot = !controls.radiance && was_pressed(Action::SCREENSHOT);
    controls.files = input_.dropped_files();
    if (has_mouse_) {
        read_play(controls.play, pad, dt_s);
    } else {
        controls.click = input_.was_clicked(GLFW_MOUSE_BUTTON_LEFT);
        rest_px_ = {};
        rest_steps_ = 0.0;
    }
    input_.forget();
    pad_ = pad;
    return controls;
}

void add_pad(const PadState& now, const PadState& before, StepInput& play) {
    if (!now.is_there || !before.is_there) return;
    const Vec2 walk = shape_stick(now.left_stick);
    if (play.right == 0) play.right = int(std::lround(FULL_SPEED * walk.x));
    if (play.forward == 0) play.forward = -int(std::lround(FULL_SPEED * walk.y));
    play.run = play.run || now.left_trigger > PULLED;
    play.crouch = play.crouch || now.b;
    play.jump = play.jump || (now.a && !before.a);
    play.use = play.use || (now.x && !before.x);
    const bool throws = now.right_trigger > PULLED && before.right_trigger <= PULLED;
    play.throw_ball = play.throw_ball || throws;
}

StepInput without_presses(const StepInput& input) {
    StepInput held;
    held.right = input.right;
    held.forward = input.forward;
    held.run = input.run;
    held.crouch = input.crouch;
    return held;
}

StepInput with_presses(const StepInput& input, const StepInput& earlier) {
    StepInput both = input;
    both.jump = input.jump || earlier.jump;
    both.throw_ball = input.throw_ball || earlier.throw_ball;
    both.use = input.use != earlier.use;  // twice is back again
    both.torch = input.torch != earlier.torch;
    both.restart = input.restart || earlier.restart;
    both.look_right += earlier.look_right;
    both.look_down += earlier.look_down;
    both.wheel += earlier.wheel;
    return both;
}

}  // namespace game
