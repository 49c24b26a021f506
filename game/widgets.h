// Dear ImGui over a window.
#pragma once

#include "window.h"

namespace game {

// One in a process. Needs the window's context current for all its life. What listens to the window's keys
// itself must have begun before.
class Widgets {
  public:
    explicit Widgets(Window& window);
    ~Widgets();
    Widgets(const Widgets&) = delete;
    Widgets& operator=(const Widgets&) = delete;

    // Starts a frame; call after Window::poll_events().
    void begin();
    // Draws the frame's widgets into the default framebuffer.
    void end();
    // Whether the mouse is over a widget, or a widget holds it.
    bool wants_mouse() const;
};

}  // namespace game
