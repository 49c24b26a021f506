// A window with an OpenGL 4.5 core context, by GLFW.
#pragma once

#include <string>

#include "tarn_names.h"

struct GLFWwindow;

namespace game {

// GLFW's version and what it was built with.
std::string describe_window_library();

struct WindowOptions {
    std::string title;
    int width_px = 1280;
    int height_px = 720;
    int gl_threads = 0;  // of a GL driver on the CPU (Mesa's llvmpipe); 0: its own choice
};

struct Size {
    int width_px = 0;
    int height_px = 0;
    bool operator==(const Size&) const = default;
};

// One at a time in a process: GLFW starts and ends with it. Its context is current on the thread that made
// it, and must outlive all that draws in it.
class Window {
  public:
    // Error where there is no display, or no OpenGL 4.5 core.
    explicit Window(const WindowOptions& options);
    ~Window();
    Window(const Window&) = delete;
    Window& operator=(const Window&) = delete;

    // Finds the functions of the window's GL.
    GlLoader gl_loader() const;

    // Shows what was drawn into the default framebuffer.
    void swap();
    // Handles all events that have come; calls the callbacks that were set on native_handle().
    void poll_events();
    // Asks for a swap per display refresh (true) or at once (false).
    void set_vsync(bool enabled);
    void set_title(const std::string& title);
    // True once the user or request_close() asked to close it.
    bool should_close() const;
    void request_close();
    // Of the default framebuffer: 0 while the window is minimized.
    Size framebuffer_size() const;
    bool is_minimized() const;
    bool has_focus() const;
    bool is_fullscreen() const;
    // Over the whole of the first monitor, or as it was before. Nothing where there is no monitor.
    void set_fullscreen(bool fullscreen);

    GLFWwindow* native_handle() const { return handle_; }

  private:
    GLFWwindow* handle_;
    int left_px_ = 0, top_px_ = 0;  // before it was fullscreen
    Size size_;
};

}  // namespace game
