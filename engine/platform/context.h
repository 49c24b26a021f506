// GL 4.5 core contexts: EGL without a window, a hidden GLFW window, or OSMesa; everything else is the same
// for all three.
#pragma once

#include <memory>
#include <string>

#include "gl/debug_output.h"
#include "gl/device_info.h"

namespace tarn {

enum class ContextKind {
    EGL,       // no window: the headless default
    GLFW,      // a hidden window
    OSMESA,    // Mesa's off-screen library, loaded at run time: the fallback where EGL is missing
    BORROWED,  // somebody else's; see create_borrowed_context
};

// "egl", "glfw", "osmesa" or "borrowed".
const char* context_kind_name(ContextKind kind);

// The kind of that name; Error for others.
ContextKind parse_context_kind(const std::string& name);

#ifdef NDEBUG
inline constexpr bool DEBUG_CONTEXT_BY_DEFAULT = false;
#else
inline constexpr bool DEBUG_CONTEXT_BY_DEFAULT = true;
#endif

struct ContextOptions {
    ContextKind kind = ContextKind::EGL;
    int gl_threads = 0;                     // rasterizer threads of llvmpipe; 0: the driver's choice
    bool debug = DEBUG_CONTEXT_BY_DEFAULT;  // record the driver's complaints: take_debug_errors()
};

// A context that is current on the thread that made it; destroy it on that thread, after all its GL objects.
class Context {
  public:
    virtual ~Context();
    Context(const Context&) = delete;
    Context& operator=(const Context&) = delete;

    // Makes this the current context of the calling thread, in place of any other, and points the GL
    // functions at its driver.
    void make_current();

    // Whether it is the one that Tarn made current last on this thread.
    bool is_current() const;

    ContextKind kind() const { return kind_; }
    const DeviceInfo& device_info() const { return device_info_; }

  protected:
    using GlFunction = void (*)();
    using GetProcAddress = GlFunction (*)(const char*);

    Context(ContextKind kind, GetProcAddress get_proc_address)
        : kind_(kind), get_proc_address_(get_proc_address) {}

    // The last step of each constructor: loads GL and checks that it is 4.5 core (Error with what was found).
    void start(bool debug);
    // The first step of each destructor: no context is current afterwards where this one was.
    void stop();

  private:
    // Makes the context current where no other one is (Error when the driver refuses); the reverse.
    virtual void bind() = 0;
    virtual void unbind() = 0;

    ContextKind kind_;
    GetProcAddress get_proc_address_;
    DeviceInfo device_info_;
    std::unique_ptr<DebugOutput> debug_output_;
};

// Creates a context and makes it current. Error when there is none of that kind, or only an older GL.
//
// EGL: environment TARN_EGL_DEVICE=index takes that EGL device; else EGL_PLATFORM is obeyed when set; else
// the first hardware device with GL 4.5 core, then Mesa's surfaceless software device, then whatever EGL
// calls its default.
//
// gl_threads = N sets LP_NUM_THREADS=N while llvmpipe starts: N workers shade and rasterize while the calling
// thread sleeps in its wait. Measured with Mesa 22.3.6 on two cores, processor time over wall time of a heavy
// compute shader and of a draw of 180 k small triangles: N = 1: 1.00 and 1.01; N = 2: 1.98 and 1.45 (vertices
// and binning stay on the calling thread). So 1 is a true limit of one core; Mesa's own LP_NUM_THREADS=0,
// everything on the calling thread, is as fast as 1. OSMesa starts llvmpipe once per process: its first
// context decides.
std::unique_ptr<Context> create_context(const ContextOptions& options);

// The context that is current on this thread, made by somebody else, with the loader of its functions. It
// must stay current while it is used, and must outlive what is returned. Error where it is not 4.5 core.
std::unique_ptr<Context> create_borrowed_context(void (*(*get_proc_address)(const char*))());

}  // namespace tarn
