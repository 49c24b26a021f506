// Widgets over a window, and the keys and mouse movements that it leaves to the viewer.
#pragma once

#include "fly_camera.h"
#include "widgets.h"
#include "window.h"
#include "window_input.h"

namespace game {

// What a person did since the last frame, outside the panel.
struct ViewerInput {
    FlyInput fly;                 // move: D, A; E, Q; W, S. fast: Shift. look_px: with the right button held
    bool close = false;           // Escape
    bool toggle_panel = false;    // Tab, F1
    bool reload_shaders = false;  // F5
    bool screenshot = false;      // F12
    bool toggle_animation = false;  // Space
};

// One in a process. Needs the window's context current for all its life.
class Overlay {
  public:
    explicit Overlay(Window& window);
    Overlay(const Overlay&) = delete;
    Overlay& operator=(const Overlay&) = delete;

    // Starts a frame and says what the viewer is to do; call after Window::poll_events(). Keys count only
    // while no widget wants them, the mouse only outside the panel.
    ViewerInput begin();
    // Draws the frame's widgets into the default framebuffer.
    void end();

  private:
    void read_keys(ViewerInput& input) const;
    void read_mouse(ViewerInput& input);

    WindowInput input_;  // before the widgets, which pass keys on to it
    Widgets widgets_;
    bool looking_ = false;
};

}  // namespace game
