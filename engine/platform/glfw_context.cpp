// Contexts in a hidden window, by GLFW.
#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <string>

#include "core/error.h"
#include "platform/backends.h"

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
GLFWwindow* open_window(bool debug, int major, int minor) {
    glfwDefaultWindowHints();
    glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, major);
    glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, minor);
    glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
    glfwWindowHint(GLFW_OPENGL_FORWARD_COMPAT, GLFW_TRUE);
    glfwWindowHint(GLFW_OPENGL_DEBUG_CONTEXT, debug ? GLFW_TRUE : GLFW_FALSE);
    glfwWindowHint(GLFW_VISIBLE, GLFW_FALSE);
    glfwWindowHint(GLFW_DEPTH_BITS, 0);
    glfwWindowHint(GLFW_STENCIL_BITS, 0);
    return glfwCreateWindow(1, 1, "Tarn", nullptr, nullptr);
}

class GlfwContext final : public Context {
  public:
    explicit GlfwContext(bool debug) : Context(ContextKind::GLFW, glfwGetProcAddress), window_(open(debug)) {
        try {
            start(debug);
        } catch (...) {
            stop();
            glfwDestroyWindow(window_);
            throw;
        }
    }

    ~GlfwContext() override {
        stop();
        glfwDestroyWindow(window_);
    }

  private:
    static GLFWwindow* open(bool debug) {
        GLFWwindow* handle = open_window(debug, 4, 5);
        const std::string reason = handle == nullptr ? describe_error() : "";
        if (handle == nullptr) handle = open_window(debug, 3, 2);
        if (handle == nullptr) throw Error("no window with OpenGL 4.5 core can be opened ({})", reason);
        return handle;
    }

    void bind() override {
        glfwMakeContextCurrent(window_);
        if (glfwGetCurrentContext() != window_)
            throw Error("the window's context cannot be made current ({})", describe_error());
    }

    void unbind() override { glfwMakeContextCurrent(nullptr); }

    GlfwLibrary library_;
    GLFWwindow* window_;
};

}  // namespace

std::unique_ptr<Context> create_glfw_context(const ContextOptions& options) {
    return std::make_unique<GlfwContext>(options.debug);
}

}  // namespace tarn
