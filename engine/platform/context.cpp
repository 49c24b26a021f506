// What all kinds of contexts share: loading GL, checking its version, debug output.
#include "platform/context.h"

#include <glad/gl.h>

#include <optional>
#include <utility>

#include "core/error.h"
#include "platform/backends.h"
#include "platform/environment.h"

namespace tarn {
namespace {

// The context that Tarn made current on this thread.
thread_local Context* current_context = nullptr;

constexpr int MIN_GL_VERSION = GLAD_MAKE_VERSION(4, 5);

std::string describe_gl() {
    const auto text = [](GLenum name) {
        const GLubyte* value = glGetString(name);
        return std::string(value != nullptr ? reinterpret_cast<const char*>(value) : "unknown");
    };
    return fmt::format("OpenGL {} ({})", text(GL_VERSION), text(GL_RENDERER));
}

void load_gl(Context& context, void (*(*get_proc_address)(const char*))()) {
    const int version = tarn_gladLoadGL(get_proc_address);
    const char* kind = context_kind_name(context.kind());
    if (version == 0) throw Error("the {} context has no OpenGL functions", kind);
    if (version < MIN_GL_VERSION)
        throw Error("Tarn needs OpenGL 4.5 core, the {} context offers {}", kind, describe_gl());
}

}  // namespace

const char* context_kind_name(ContextKind kind) {
    switch (kind) {
        case ContextKind::EGL:
            return "egl";
        case ContextKind::GLFW:
            return "glfw";
        case ContextKind::OSMESA:
            return "osmesa";
        case ContextKind::BORROWED:
            return "borrowed";
    }
    return "unknown";
}

ContextKind parse_context_kind(const std::string& name) {
    for (const ContextKind kind : {ContextKind::EGL, ContextKind::GLFW, ContextKind::OSMESA})
        if (name == context_kind_name(kind)) return kind;
    throw Error("context '{}' is unknown: egl, glfw or osmesa", name);
}

Context::~Context() = default;

// EGL, GLX and OSMesa each believe to be alone in a thread: one must let go before the next takes hold. And
// each brings its own GL functions.
void Context::make_current() {
    // Somebody else's is current already, and whatever else is would be theirs too.
    if (kind_ == ContextKind::BORROWED) return load_gl(*this, get_proc_address_);
    if (current_context != nullptr) std::exchange(current_context, nullptr)->unbind();
    bind();
    current_context = this;
    load_gl(*this, get_proc_address_);
}

bool Context::is_current() const {
    return current_context == this;
}

void Context::stop() {
    if (current_context != this) return;
    unbind();
    current_context = nullptr;
}

void Context::start(bool debug) {
    make_current();
    device_info_ = query_device_info();
    if (!device_info_.is_core_profile)
        throw Error("Tarn needs OpenGL 4.5 core, the {} context offers a compatibility profile of {}",
                    context_kind_name(kind_), describe_gl());
    if (debug) debug_output_ = std::make_unique<DebugOutput>();
}

std::unique_ptr<Context> create_context(const ContextOptions& options) {
    if (options.gl_threads < 0) throw Error("gl_threads is {}, must be 0 or more", options.gl_threads);
    std::optional<ScopedEnvironment> threads;
    if (options.gl_threads > 0) threads.emplace("LP_NUM_THREADS", std::to_string(options.gl_threads));
    switch (options.kind) {
        case ContextKind::EGL:
            return create_egl_context(options);
        case ContextKind::GLFW:
#ifdef TARN_HAS_GLFW
            return create_glfw_context(options);
#else
            throw Error("this library was built without GLFW (TARN_TOOLS): it opens no windows");
#endif
        case ContextKind::OSMESA:
            return create_osmesa_context(options);
        case ContextKind::BORROWED:
            break;
    }
    throw Error("context kind {} is unknown", int(options.kind));
}

}  // namespace tarn
