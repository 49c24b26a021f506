// Keys, mouse and gamepad as the sandbox understands them.
#pragma once

#include <string>
#include <vector>

#include "../gamepad.h"
#include "../play/step_input.h"
#include "../window_input.h"
#include "key_map.h"

namespace game {

// What a person did since the last frame.
struct Controls {
    StepInput play;      // with all that was pressed since then; only while the mouse is captured
    bool leave = false;  // Escape
    bool pause = false;  // a gamepad's start: free the mouse, or go on
    bool click = false;  // the left button, while the mouse is free
    bool help = false;
    bool panel = false;
    bool save = false;
    bool load = false;
    bool fullscreen = false;
    bool screenshot = false;         // as the eye sees it
    bool radiance = false;           // the same key with Shift: a screenshot of linear radiance
    std::vector<std::string> files;  // that were dropped on the window
};

class ControlReader {
  public:
    // Hears the window's keys before widgets do.
    ControlReader(Window& window, const KeyMap& keys) : input_(window), keys_(keys) {}

    // Call after Window::poll_events(), `dt_s` seconds after the last time.
    Controls read(double dt_s);
    // Hides the mouse pointer, so that the mouse turns the head, or gives it back.
    void capture_mouse(bool captured);
    bool has_mouse() const { return has_mouse_; }

  private:
    void read_play(StepInput& play, const PadState& pad, double dt_s);

    bool is_held(Action action) const;
    bool was_pressed(Action action) const;

    WindowInput input_;
    KeyMap keys_;
    PadState pad_;  // at the last look
    bool has_mouse_ = false;
    int unsettled_looks_ = 0;  // since it was captured: until the pointer is where the window system wants it
    Vec2 rest_px_;             // of the mouse's way: less than a pixel
    double rest_steps_ = 0.0;
};

// What a gamepad asks for beside the keys; `before`: the same at the last look. One that has just been
// plugged in asks for nothing.
void add_pad(const PadState& now, const PadState& before, StepInput& play);

// Of one frame's input: what the first step of the frame gets is in it; further ones get only what is held.
StepInput without_presses(const StepInput& input);
// What was pressed in `earlier`, and not yet used by any step, added to `input`.
StepInput with_presses(const StepInput& input, const StepInput& earlier);

}  // namespace game
