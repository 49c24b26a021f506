// Keys and buttons of a window that were pressed since the last look, however short: a slow frame misses
// none.
#pragma once

#include <set>
#include <string>
#include <vector>

#include "vectors.h"
#include "window.h"

namespace game {

class WindowInput {
  public:
    // Listens to the window's keys and mouse; make it before other listeners, which pass on what they get.
    // Holds the window's user pointer.
    explicit WindowInput(Window& window);
    ~WindowInput();
    WindowInput(const WindowInput&) = delete;
    WindowInput& operator=(const WindowInput&) = delete;

    // Whether `key` (GLFW_KEY_*, a place on the US keyboard) is down, or was since the last forget().
    bool is_held(int key) const;
    // Whether `key` went down since the last forget().
    bool was_pressed(int key) const { return pressed_.contains(key); }
    // The same, with Shift held at that moment.
    bool was_pressed_with_shift(int key) const { return shifted_.contains(key); }
    // Whether mouse button `button` (GLFW_MOUSE_BUTTON_*) went down since the last forget().
    bool was_clicked(int button) const { return clicked_.contains(button); }
    // Of the wheel since the last forget(); positive: away from the hand.
    double wheel_steps() const { return wheel_steps_; }
    // Files that were dropped on the window since the last forget().
    const std::vector<std::string>& dropped_files() const { return dropped_files_; }
    // The way of the mouse since the last call, pixels to the right and down, while it was captured.
    Vec2 take_mouse_way();
    void forget();

    // Hides the mouse pointer and lets it move without end, or gives it back.
    void capture_mouse(bool captured);

  private:
    Window& window_;
    std::set<int> pressed_;
    std::set<int> shifted_;
    std::set<int> clicked_;
    std::vector<std::string> dropped_files_;
    double wheel_steps_ = 0.0;
    Vec2 mouse_px_;  // at the last take_mouse_way()
    bool captured_ = false;
};

}  // namespace game
