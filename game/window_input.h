// Keys of a window that were pressed since the last look, however short: a slow frame misses none.
#pragma once

#include <set>

#include "window.h"

namespace game {

class WindowInput {
  public:
    // Listens to the window's keys; make it before other listeners, which pass keys on to it. Holds the
    // window's user pointer.
    explicit WindowInput(Window& window);
    ~WindowInput();
    WindowInput(const WindowInput&) = delete;
    WindowInput& operator=(const WindowInput&) = delete;

    // Whether `key` (GLFW_KEY_*, a place on the US keyboard) is down, or was since the last forget().
    bool is_held(int key) const;
    // Whether `key` went down since the last forget().
    bool was_pressed(int key) const { return pressed_.contains(key); }
    void forget() { pressed_.clear(); }

    // Hides the mouse pointer and lets it move without end, or gives it back.
    void capture_mouse(bool captured);

  private:
    Window& window_;
    std::set<int> pressed_;
    bool captured_ = false;
};

}  // namespace game
