// Contexts in a window, by GLFW.
#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <string>

#include "core/error.h"
#include "platform/backends.h"
#include "platform/window.h"

namespace tarn {
namespace {

std::string describe_error() {
    const char* text = nullptr;
    glfwGetError(&text);
    return text != nullptr ? text : "GLFW gives no reason";
}

// GLFW is one per process: started with the first window, ended with the last.
class GlfwLibrary {
  public:
    GlfwLibrary() {
        if (count_++ > 0 || glfwInit() == GLFW_TRUE) return;
        --count_;
        throw Error("no window can be opened ({}): no display? set DISPLAY or use --context egl",
                    describe_error());
    }
    ~GlfwLibrary() {
        if (--count_ == 0) glfwTerminate();
    }
    GlfwLibrary(const GlfwLibrary&) = delete;
    GlfwLibrary& operator=(const GlfwLibrary&) = delete;

  private:
    static inline int count_ = 0;
};

// The window of an older GL serves only to tell which version there is.
GLFWwindow* open_window(const ContextOptions& options, int major, int minor) {
    glfwDefaultWindowHints();
    glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, major);
    glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, minor);
    glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
    glfwWindowHint(GLFW_OPENGL_FORWARD_COMPAT, GLFW_TRUE);
    glfwWindowHint(GLFW_OPENGL_DEBUG_CONTEXT, options.debug ? GLFW_TRUE : GLFW_FALSE);
    glfwWindowHint(GLFW_VISIBLE, options.window_visible ? GLFW_TRUE : GLFW_FALSE);
    glfwWindowHint(GLFW_DEPTH_BITS, 0);
    glfwWindowHint(GLFW_STENCIL_BITS, 0);
    return glfwCreateWindow(options.window_width_px, options.window_height_px, options.window_title.c_str(),
                            nullptr, nullptr);
}

class GlfwContext final : public Context {
  public:
    explicit GlfwContext(const ContextOptions& options)
        : Context(ContextKind::GLFW, glfwGetProcAddress), window_(open(options)) {
        try {
            start(options.debug);
        } catch (...) {
            stop();
            glfwDestroyWindow(window_.native_handle());
            throw;
        }
    }

    ~GlfwContext() override {
        stop();
        glfwDestroyWindow(window_.native_handle());
    }

    Window* window() override { return &window_; }

  private:
    static GLFWwindow* open(const ContextOptions& options) {
        GLFWwindow* handle = open_window(options, 4, 5);
        const std::string reason = handle == nullptr ? describe_error() : "";
        if (handle == nullptr) handle = open_window(options, 3, 2);
        if (handle == nullptr)
            throw Error("no window of {}x{} px with OpenGL 4.5 core can be opened ({})",
                        options.window_width_px, options.window_height_px, reason);
        return handle;
    }

    void bind() override {
        glfwMakeContextCurrent(window_.native_handle());
        if (glfwGetCurrentContext() != window_.native_handle())
            throw Error("the window's context cannot be made current ({})", describe_error());
    }

    void unbind() override { glfwMakeContextCurrent(nullptr); }

    GlfwLibrary library_;
    Window window_;
};

}  // namespace

std::string describe_window_library() {
    return glfwGetVersionString();
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

glm::ivec2 Window::framebuffer_size_px() const {
    glm::ivec2 size_px(0);
    glfwGetFramebufferSize(handle_, &size_px.x, &size_px.y);
    return size_px;
}

std::unique_ptr<Context> create_glfw_context(const ContextOptions& options) {
    return std::make_unique<GlfwContext>(options);
}

}  // namespace tarn
