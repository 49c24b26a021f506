#include "window_input.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

namespace game {

namespace {

WindowInput& input_of(GLFWwindow* handle) {
    return *static_cast<WindowInput*>(glfwGetWindowUserPointer(handle));
}

}  // namespace

WindowInput::WindowInput(Window& window) : window_(window) {
    GLFWwindow* handle = window_.native_handle();
    glfwSetWindowUserPointer(handle, this);
    glfwSetKeyCallback(handle, [](GLFWwindow* sender, int key, int, int action, int modifiers) {
        if (action != GLFW_PRESS) return;
        input_of(sender).pressed_.insert(key);
        if ((modifiers & GLFW_MOD_SHIFT) != 0) input_of(sender).shifted_.insert(key);
    });
    glfwSetMouseButtonCallback(handle, [](GLFWwindow* sender, int button, int action, int) {
        if (action == GLFW_PRESS) input_of(sender).clicked_.insert(button);
    });
    glfwSetScrollCallback(
        handle, [](GLFWwindow* sender, double, double steps) { input_of(sender).wheel_steps_ += steps; });
    glfwSetDropCallback(handle, [](GLFWwindow* sender, int count, const char** files) {
        std::vector<std::string>& list = input_of(sender).dropped_files_;
        list.insert(list.end(), files, files + count);
    });
}

WindowInput::~WindowInput() {
    glfwSetKeyCallback(window_.native_handle(), nullptr);
    glfwSetMouseButtonCallback(window_.native_handle(), nullptr);
    glfwSetScrollCallback(window_.native_handle(), nullptr);
    glfwSetDropCallback(window_.native_handle(), nullptr);
    glfwSetWindowUserPointer(window_.native_handle(), nullptr);
}

void WindowInput::forget() {
    pressed_.clear();
    shifted_.clear();
    clicked_.clear();
    dropped_files_.clear();
    wheel_steps_ = 0.0;
}

Vec2 WindowInput::take_mouse_way() {
    Vec2 now;
    glfwGetCursorPos(window_.native_handle(), &now.x, &now.y);
    const Vec2 before = mouse_px_;
    mouse_px_ = now;
    return captured_ ? Vec2{now.x - before.x, now.y - before.y} : Vec2();
}

bool WindowInput::is_held(int key) const {
    return was_pressed(key) || glfwGetKey(window_.native_handle(), key) == GLFW_PRESS;
}

void WindowInput::capture_mouse(bool captured) {
    if (captured == captured_) return;
    captured_ = captured;
    glfwSetInputMode(window_.native_handle(), GLFW_CURSOR,
                     captured ? GLFW_CURSOR_DISABLED : GLFW_CURSOR_NORMAL);
    glfwGetCursorPos(window_.native_handle(), &mouse_px_.x, &mouse_px_.y);
}

}  // namespace game
