// Headless contexts by EGL: a hardware device where one works, else Mesa's surfaceless software device.
#include <EGL/egl.h>
#include <EGL/eglext.h>

#include <cstdlib>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/error.h"
#include "platform/backends.h"
#include "platform/environment.h"

namespace tarn {
namespace {

// Whole words only: EGL_EXT_device_base must not be found in EGL_EXT_device_base_2.
bool has_word(const char* words, std::string_view word) {
    if (words == nullptr) return false;
    const std::string_view text = words;
    for (std::size_t at = text.find(word); at != text.npos; at = text.find(word, at + 1)) {
        const std::size_t end = at + word.size();
        if ((at == 0 || text[at - 1] == ' ') && (end == text.size() || text[end] == ' ')) return true;
    }
    return false;
}

bool has_client_extension(std::string_view name) {
    return has_word(eglQueryString(EGL_NO_DISPLAY, EGL_EXTENSIONS), name);
}

template <class Function>
Function load_egl_function(const char* name) {
    return reinterpret_cast<Function>(eglGetProcAddress(name));
}

// A display to try, and how to call it in messages.
struct Candidate {
    std::string name;
    EGLDisplay display;
};

EGLDisplay get_platform_display(EGLenum platform, void* native) {
    const auto get_display = load_egl_function<PFNEGLGETPLATFORMDISPLAYEXTPROC>("eglGetPlatformDisplayEXT");
    return get_display != nullptr ? get_display(platform, native, nullptr) : EGL_NO_DISPLAY;
}

std::vector<EGLDeviceEXT> list_devices() {
    const bool can_list =
        has_client_extension("EGL_EXT_device_enumeration") || has_client_extension("EGL_EXT_device_base");
    const auto query_devices = load_egl_function<PFNEGLQUERYDEVICESEXTPROC>("eglQueryDevicesEXT");
    EGLint count = 0;
    if (!can_list || !has_client_extension("EGL_EXT_platform_device") || query_devices == nullptr ||
        !query_devices(0, nullptr, &count))
        return {};
    std::vector<EGLDeviceEXT> devices(std::size_t(count), nullptr);
    if (count > 0 && !query_devices(count, devices.data(), &count)) return {};
    devices.resize(std::size_t(count));
    return devices;
}

bool is_software_device(EGLDeviceEXT device) {
    const auto query_string = load_egl_function<PFNEGLQUERYDEVICESTRINGEXTPROC>("eglQueryDeviceStringEXT");
    return query_string != nullptr &&
           has_word(query_string(device, EGL_EXTENSIONS), "EGL_MESA_device_software");
}

Candidate device_candidate(EGLDeviceEXT device, std::size_t index) {
    return {fmt::format("device {}", index), get_platform_display(EGL_PLATFORM_DEVICE_EXT, device)};
}

Candidate chosen_device(const std::string& choice) {
    const std::vector<EGLDeviceEXT> devices = list_devices();
    char* end = nullptr;
    const unsigned long index = std::strtoul(choice.c_str(), &end, 10);
    if (*end != '\0' || index >= devices.size())
        throw Error("TARN_EGL_DEVICE is '{}', EGL lists {} devices (counted from 0)", choice, devices.size());
    return device_candidate(devices[index], index);
}

// All displays worth a try, best first: see create_context.
std::vector<Candidate> list_candidates() {
    if (const auto choice = get_environment("TARN_EGL_DEVICE")) return {chosen_device(*choice)};
    const auto platform = get_environment("EGL_PLATFORM");
    const Candidate fallback{"default display", eglGetDisplay(EGL_DEFAULT_DISPLAY)};
    if (platform && *platform != "surfaceless") return {fallback};

    std::vector<Candidate> candidates;
    if (!platform) {
        const std::vector<EGLDeviceEXT> devices = list_devices();
        for (std::size_t i = 0; i < devices.size(); ++i)
            if (!is_software_device(devices[i])) candidates.push_back(device_candidate(devices[i], i));
    }
    if (has_client_extension("EGL_MESA_platform_surfaceless"))
        candidates.push_back({"surfaceless", get_platform_display(EGL_PLATFORM_SURFACELESS_MESA, nullptr)});
    candidates.push_back(fallback);
    return candidates;
}

// EGL counts no users of a display: the first eglTerminate ends it for all contexts in the process. So we
// count.
int& display_users(EGLDisplay display) {
    static std::map<EGLDisplay, int> users;
    return users[display];
}

// The display, the context and, where contexts need one, a surface of one pixel; released in reverse.
class EglContext final : public Context {
  public:
    EglContext(const Candidate& candidate, bool debug)
        : Context(ContextKind::EGL, eglGetProcAddress), display_(candidate.display) {
        try {
            open(debug);
            start(debug);
        } catch (...) {
            stop();
            close();
            throw;
        }
    }

    ~EglContext() override {
        stop();
        close();
    }

  private:
    void open(bool debug) {
        EGLint major = 0;
        EGLint minor = 0;
        if (display_ == EGL_NO_DISPLAY) throw Error("there is no such display");
        if (!eglInitialize(display_, &major, &minor)) throw Error("it does not start ({})", describe_error());
        ++display_users(display_);
        initialized_ = true;
        if (std::pair(major, minor) < std::pair(1, 4))
            throw Error("it has EGL {}.{}, 1.4 is needed", major, minor);
        if (!eglBindAPI(EGL_OPENGL_API)) throw Error("it has no desktop OpenGL ({})", describe_error());
        const EGLConfig config = choose_config();
        context_ = create_core_context(config, 4, 5, debug);
        // An older context serves only to tell which version there is.
        if (context_ == EGL_NO_CONTEXT) context_ = create_core_context(config, 3, 2, false);
        if (context_ == EGL_NO_CONTEXT) throw Error("it has no OpenGL core context ({})", describe_error());
        if (!has_display_extension("EGL_KHR_surfaceless_context")) {
            const EGLint size[] = {EGL_WIDTH, 1, EGL_HEIGHT, 1, EGL_NONE};
            surface_ = eglCreatePbufferSurface(display_, config, size);
            if (surface_ == EGL_NO_SURFACE)
                throw Error("it has no off-screen surface ({})", describe_error());
        }
    }

    void close() {
        if (!initialized_) return;
        if (surface_ != EGL_NO_SURFACE) eglDestroySurface(display_, surface_);
        if (context_ != EGL_NO_CONTEXT) eglDestroyContext(display_, context_);
        if (--display_users(display_) == 0) eglTerminate(display_);
    }

    void bind() override {
        // The API is state of the thread, which other code on it may have changed.
        eglBindAPI(EGL_OPENGL_API);
        if (!eglMakeCurrent(display_, surface_, surface_, context_))
            throw Error("the EGL context cannot be made current ({})", describe_error());
    }

    void unbind() override { eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT); }

    EGLConfig choose_config() const {
        const EGLint wanted[] = {EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT, EGL_SURFACE_TYPE, EGL_PBUFFER_BIT,
                                 EGL_NONE};
        EGLConfig config = EGL_NO_CONFIG_KHR;
        EGLint count = 0;
        if (eglChooseConfig(display_, wanted, &config, 1, &count) && count > 0) return config;
        if (has_display_extension("EGL_KHR_no_config_context")) return EGL_NO_CONFIG_KHR;
        throw Error("it has no configuration for OpenGL ({})", describe_error());
    }

    EGLContext create_core_context(EGLConfig config, int major, int minor, bool debug) const {
        std::vector<EGLint> attributes = {
            EGL_CONTEXT_MAJOR_VERSION_KHR,       major,
            EGL_CONTEXT_MINOR_VERSION_KHR,       minor,
            EGL_CONTEXT_OPENGL_PROFILE_MASK_KHR, EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT_KHR};
        if (debug)
            attributes.insert(attributes.end(), {EGL_CONTEXT_FLAGS_KHR, EGL_CONTEXT_OPENGL_DEBUG_BIT_KHR});
        attributes.push_back(EGL_NONE);
        return eglCreateContext(display_, config, EGL_NO_CONTEXT, attributes.data());
    }

    bool has_display_extension(std::string_view name) const {
        return has_word(eglQueryString(display_, EGL_EXTENSIONS), name);
    }

    static std::string describe_error() { return fmt::format("EGL error 0x{:04x}", eglGetError()); }

    EGLDisplay display_;
    bool initialized_ = false;
    EGLContext context_ = EGL_NO_CONTEXT;
    EGLSurface surface_ = EGL_NO_SURFACE;
};

}  // namespace

std::unique_ptr<Context> create_egl_context(const ContextOptions& options) {
    std::string reasons;
    for (const Candidate& candidate : list_candidates()) {
        try {
            return std::make_unique<EglContext>(candidate, options.debug);
        } catch (const Error& error) {
            reasons += fmt::format("{}{}: {}", reasons.empty() ? "" : "; ", candidate.name, error.what());
        }
    }
    throw Error("EGL has no OpenGL 4.5 core context: {}", reasons);
}

}  // namespace tarn
