// Off-screen contexts by OSMesa. The library is loaded at run time: linked beside libEGL or libGL it would
// bring a second set of GL entry points into the program.
#include <dlfcn.h>

#include <array>
#include <cstdint>
#include <optional>

#include "core/error.h"
#include "platform/backends.h"
#include "platform/environment.h"

namespace tarn {
namespace {

// What <GL/osmesa.h> declares; including it would pull in <GL/gl.h>, which glad replaces.
constexpr int OSMESA_RGBA = 0x1908;
constexpr int OSMESA_FORMAT = 0x22;
constexpr int OSMESA_DEPTH_BITS = 0x30;
constexpr int OSMESA_PROFILE = 0x33;
constexpr int OSMESA_CORE_PROFILE = 0x34;
constexpr int OSMESA_CONTEXT_MAJOR_VERSION = 0x36;
constexpr int OSMESA_CONTEXT_MINOR_VERSION = 0x37;
constexpr unsigned OSMESA_UNSIGNED_BYTE = 0x1401;

using OsmesaHandle = void*;
using GlFunction = void (*)();

struct OsmesaLibrary {
    OsmesaHandle (*create_context)(const int* attributes, OsmesaHandle share);
    void (*destroy_context)(OsmesaHandle);
    unsigned char (*make_current)(OsmesaHandle, void* pixels, unsigned type, int width, int height);
    GlFunction (*get_proc_address)(const char*);
};

template <class Function>
void load_function(void* library, const char* name, Function& function) {
    function = reinterpret_cast<Function>(dlsym(library, name));
    if (function == nullptr) throw Error("libOSMesa has no function {}: Mesa 17 or later is needed", name);
}

// Never unloaded: Mesa leaves threads and exit handlers behind.
OsmesaLibrary load_library() {
    void* handle = nullptr;
    for (const char* name : {"libOSMesa.so.8", "libOSMesa.so.6", "libOSMesa.so"})
        if (handle == nullptr) handle = dlopen(name, RTLD_NOW | RTLD_LOCAL);
    if (handle == nullptr) throw Error("OSMesa is missing: {}", dlerror());
    OsmesaLibrary library = {};
    load_function(handle, "OSMesaCreateContextAttribs", library.create_context);
    load_function(handle, "OSMesaDestroyContext", library.destroy_context);
    load_function(handle, "OSMesaMakeCurrent", library.make_current);
    load_function(handle, "OSMesaGetProcAddress", library.get_proc_address);
    return library;
}

class OsmesaContext final : public Context {
  public:
    OsmesaContext(const OsmesaLibrary& library, bool debug)
        : Context(ContextKind::OSMESA, library.get_proc_address), library_(library), context_(open(library)) {
        try {
            start(debug);
        } catch (...) {
            stop();
            library_.destroy_context(context_);
            throw;
        }
    }

    ~OsmesaContext() override {
        stop();
        library_.destroy_context(context_);
    }

  private:
    // An older context serves only to tell which version there is.
    static OsmesaHandle open(const OsmesaLibrary& library) {
        OsmesaHandle context = create_core_context(library, 4, 5);
        if (context == nullptr) context = create_core_context(library, 3, 2);
        if (context == nullptr) throw Error("OSMesa has no OpenGL core context");
        return context;
    }

    static OsmesaHandle create_core_context(const OsmesaLibrary& library, int major, int minor) {
        const int attributes[] = {OSMESA_FORMAT,
                                  OSMESA_RGBA,
                                  OSMESA_DEPTH_BITS,
                                  0,
                                  OSMESA_PROFILE,
                                  OSMESA_CORE_PROFILE,
                                  OSMESA_CONTEXT_MAJOR_VERSION,
                                  major,
                                  OSMESA_CONTEXT_MINOR_VERSION,
                                  minor,
                                  0};
        return library.create_context(attributes, nullptr);
    }

    void bind() override {
        if (!library_.make_current(context_, pixels_.data(), OSMESA_UNSIGNED_BYTE, SIDE_PX, SIDE_PX))
            throw Error("the OSMesa context cannot be made current");
    }

    void unbind() override { library_.make_current(nullptr, nullptr, 0, 0, 0); }

    // OSMesa insists on a colour buffer, in memory of ours; Tarn draws into framebuffers of its own.
    static constexpr int SIDE_PX = 4;
    std::array<std::uint32_t, SIDE_PX* SIDE_PX> pixels_ = {};
    OsmesaLibrary library_;
    OsmesaHandle context_;
};

}  // namespace

std::unique_ptr<Context> create_osmesa_context(const ContextOptions& options) {
    // Without a choice of the user's, Mesa would take its slow reference driver where llvmpipe is not the
    // default.
    std::optional<ScopedEnvironment> driver;
    if (!get_environment("GALLIUM_DRIVER")) driver.emplace("GALLIUM_DRIVER", "llvmpipe");
    return std::make_unique<OsmesaContext>(load_library(), options.debug);
}

}  // namespace tarn
