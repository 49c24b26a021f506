// The window of a GLFW context: the only place that knows its native handle.
#pragma once

#include <glm/glm.hpp>

#include <string>

struct GLFWwindow;

namespace tarn {

// GLFW's version and what it was built with; "none" in a library without windows.
std::string describe_window_library();

class Window {
  public:
    explicit Window(GLFWwindow* handle) : handle_(handle) {}

    // Shows what was drawn into the default framebuffer.
    void swap();
    // Handles all events that have come; calls the callbacks that the user interface set on native_handle().
    void poll_events();
    // Asks for a swap per display refresh (true) or at once (false).
    void set_vsync(bool enabled);
    void set_title(const std::string& title);
    // True once the user or request_close() asked to close it.
    bool should_close() const;
    void request_close();
    // Size of the default framebuffer, in pixels: 0 while the window is minimized.
    glm::ivec2 framebuffer_size_px() const;

    GLFWwindow* native_handle() const { return handle_; }

  private:
    GLFWwindow* handle_;
};

}  // namespace tarn
