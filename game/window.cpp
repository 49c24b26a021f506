#include "window.h"

#include <fmt/format.h>
#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <cstdlib>
#include <optional>

namespace game {
namespace {

std::string describe_error() {
    const char* text = nullptr;
    glfwGetError(&text);
    return text != nullptr ? text : "GLFW gives no reason";
}

// llvmpipe reads the number of its threads when it starts, from this variable; what was there comes back.
class DriverThreads {
  public:
    explicit DriverThreads(int threads) {
        if (threads <= 0) return;
        is_set_ = true;
        if (const char* value = std::getenv(NAME)) previous_ = value;
        setenv(NAME, std::to_string(threads).c_str(), 1);
    }
    ~DriverThreads() {
        if (!is_set_) return;
        if (previous_) {
            setenv(NAME, previous_->c_str(), 1);
        } else {
            unsetenv(NAME);
        }
    }
    DriverThreads(const DriverThreads&) = delete;
    DriverThreads& operator=(const DriverThreads&) = delete;

  private:
    static constexpr const char* NAME = "LP_NUM_THREADS";
    bool is_set_ = false;
    std::optional<std::string> previous_;
};

GLFWwindow* open_window(const WindowOptions& options, int major, int minor) {
    glfwDefaultWindowHints();
    glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, major);
    glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, minor);
    glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
    glfwWindowHint(GLFW_OPENGL_FORWARD_COMPAT, GLFW_TRUE);
    glfwWindowHint(GLFW_DEPTH_BITS, 0);
    glfwWindowHint(GLFW_STENCIL_BITS, 0);
    return glfwCreateWindow(options.width_px, options.height_px, options.title.c_str(), nullptr, nullptr);
}

GLFWwindow* start(const WindowOptions& options) {
    if (glfwInit() != GLFW_TRUE)
        throw Error(fmt::format("no window can be opened ({}): no display? set DISPLAY", describe_error()));
    const DriverThreads threads(options.gl_threads);
    GLFWwindow* handle = open_window(options, 4, 5);
    const std::string reason = handle == nullptr ? describe_error() : "";
    // The engine refuses an older GL, and says which one it is.
    if (handle == nullptr) handle = open_window(options, 3, 2);
    if (handle == nullptr) {
        glfwTerminate();
        throw Error(fmt::format("no window of {}x{} px with OpenGL 4.5 core can be opened ({})",
                                options.width_px, options.height_px, reason));
    }
    glfwMakeContextCurrent(handle);
    return handle;
}

}  // namespace

std::string describe_window_library() {
    return glfwGetVersionString();
}

Window::Window(const WindowOptions& options) : handle_(start(options)) {}

Window::~Window() {
    glfwDestroyWindow(handle_);
    glfwTerminate();
}

GlLoader Window::gl_loader() const {
    return glfwGetProcAddress;
}

void Window::swap() {
    glfwSwapBuffers(handle_);
}

void Window::poll_events() {
    glfwPollEvents();
}

void Window::set_vsync(bool enabled) {
    glfwSwapInterval(enabled ? 1 : 0);
}

void Window::set_title(const std::string& title) {
    glfwSetWindowTitle(handle_, title.c_str());
}

bool Window::should_close() const {
    return glfwWindowShouldClose(handle_) == GLFW_TRUE;
}

void Window::request_close() {
    glfwSetWindowShouldClose(handle_, GLFW_TRUE);
}

Size Window::framebuffer_size() const {
    Size size;
    glfwGetFramebufferSize(handle_, &size.width_px, &size.height_px);
    return size;
}

bool Window::is_minimized() const {
    return glfwGetWindowAttrib(handle_, GLFW_ICONIFIED) == GLFW_TRUE || framebuffer_size() == Size{};
}

bool Window::has_focus() const {
    return glfwGetWindowAttrib(handle_, GLFW_FOCUSED) == GLFW_TRUE;
}

bool Window::is_fullscreen() const {
    return glfwGetWindowMonitor(handle_) != nullptr;
}

void Window::set_fullscreen(bool fullscreen) {
    if (fullscreen == is_fullscreen()) return;
    if (!fullscreen) {
        glfwSetWindowMonitor(handle_, nullptr, left_px_, top_px_, size_.width_px, size_.height_px,
                             GLFW_DONT_CARE);
        return;
    }
    GLFWmonitor* monitor = glfwGetPrimaryMonitor();
    const GLFWvidmode* mode = monitor != nullptr ? glfwGetVideoMode(monitor) : nullptr;
    if (mode == nullptr) return;
    glfwGetWindowPos(handle_, &left_px_, &top_px_);
    glfwGetWindowSize(handle_, &size_.width_px, &size_.height_px);
    glfwSetWindowMonitor(handle_, monitor, 0, 0, mode->width, mode->height, mode->refreshRate);
}

}  // namespace game
