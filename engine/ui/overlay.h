// Dear ImGui over a window, and the keys and mouse movements that it leaves to the viewer.
#pragma once

#include <glm/glm.hpp>

#include "platform/window.h"
#include "ui/window_input.h"

namespace tarn {

// What a person did since the last frame, outside the panel.
struct ViewerInput {
    glm::dvec3 move{0.0};     // right (D, A), up (E, Q), forward (W, S); -1 to 1
    bool fast = false;        // Shift
    glm::dvec2 look_px{0.0};  // mouse movement with the right button held: right, down
    double wheel_steps = 0.0;
    bool close = false;             // Escape
    bool toggle_panel = false;      // Tab, F1
    bool reload_shaders = false;    // F5
    bool screenshot = false;        // F12
    bool toggle_animation = false;  // Space
};

// One in a process. Needs the window's context current for all its life.
class Overlay {
  public:
    explicit Overlay(Window& window);
    ~Overlay();
    Overlay(const Overlay&) = delete;
    Overlay& operator=(const Overlay&) = delete;

    // Starts a frame and says what the viewer is to do; call after Window::poll_events(). Keys count only
    // while no widget wants them, the mouse only outside the panel.
    ViewerInput begin();
    // Draws the frame's widgets into the default framebuffer.
    void end();

    bool is_minimized() const { return input_.is_minimized(); }

  private:
    void read_keys(ViewerInput& input) const;
    void read_mouse(ViewerInput& input);

    WindowInput input_;
    bool looking_ = false;
};

}  // namespace tarn
