#include "window_input.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

namespace game {

WindowInput::WindowInput(Window& window) : window_(window) {
    glfwSetWindowUserPointer(window_.native_handle(), this);
    glfwSetKeyCallback(window_.native_handle(), [](GLFWwindow* handle, int key, int, int action, int) {
        if (action == GLFW_PRESS)
            static_cast<WindowInput*>(glfwGetWindowUserPointer(handle))->pressed_.insert(key);
    });
}

WindowInput::~WindowInput() {
    glfwSetKeyCallback(window_.native_handle(), nullptr);
    glfwSetWindowUserPointer(window_.native_handle(), nullptr);
}

bool WindowInput::is_held(int key) const {
    return was_pressed(key) || glfwGetKey(window_.native_handle(), key) == GLFW_PRESS;
}

void WindowInput::capture_mouse(bool captured) {
    if (captured == captured_) return;
    captured_ = captured;
    glfwSetInputMode(window_.native_handle(), GLFW_CURSOR,
                     captured ? GLFW_CURSOR_DISABLED : GLFW_CURSOR_NORMAL);
}

}  // namespace game
