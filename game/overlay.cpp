#include "overlay.h"

#include <imgui.h>
#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

namespace game {

Overlay::Overlay(Window& window) : input_(window), widgets_(window) {}

ViewerInput Overlay::begin() {
    widgets_.begin();
    ViewerInput input;
    if (!ImGui::GetIO().WantCaptureKeyboard) read_keys(input);
    input_.forget();
    read_mouse(input);
    return input;
}

void Overlay::end() {
    widgets_.end();
}

void Overlay::read_keys(ViewerInput& input) const {
    const auto axis = [&](int positive, int negative) {
        return double(input_.is_held(positive)) - double(input_.is_held(negative));
    };
    input.fly.move = {axis(GLFW_KEY_D, GLFW_KEY_A), axis(GLFW_KEY_E, GLFW_KEY_Q),
                      axis(GLFW_KEY_W, GLFW_KEY_S)};
    input.fly.fast = input_.is_held(GLFW_KEY_LEFT_SHIFT) || input_.is_held(GLFW_KEY_RIGHT_SHIFT);
    input.close = input_.was_pressed(GLFW_KEY_ESCAPE);
    input.toggle_panel = input_.was_pressed(GLFW_KEY_TAB) || input_.was_pressed(GLFW_KEY_F1);
    input.reload_shaders = input_.was_pressed(GLFW_KEY_F5);
    input.screenshot = input_.was_pressed(GLFW_KEY_F12);
    input.toggle_animation = input_.was_pressed(GLFW_KEY_SPACE);
}

void Overlay::read_mouse(ViewerInput& input) {
    const ImGuiIO& io = ImGui::GetIO();
    // A drag that began outside the panel keeps the mouse, wherever it goes.
    const bool dragging = ImGui::IsMouseDown(ImGuiMouseButton_Right) && !io.WantCaptureMouse;
    // The movement that led to the first frame of a drag happened before the button went down.
    if (dragging && looking_) input.fly.look_px = {io.MouseDelta.x, io.MouseDelta.y};
    if (!io.WantCaptureMouse) input.fly.wheel_steps = io.MouseWheel;
    looking_ = dragging;
    input_.capture_mouse(dragging);
}

}  // namespace game
