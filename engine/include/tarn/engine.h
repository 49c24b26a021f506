// The engine, and views that render a scene.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>

#include "tarn/camera.h"
#include "tarn/display.h"
#include "tarn/picture.h"
#include "tarn/scene.h"
#include "tarn/settings.h"

namespace tarn::api {

// Finds GL functions by name, as glfwGetProcAddress and eglGetProcAddress do.
using GlFunction = void (*)();
using GlLoader = GlFunction (*)(const char* name);

// The share/tarn folder of the installed package. find_package(tarn) sets it; empty where Tarn is a part of
// the build.
inline std::filesystem::path package_data_folder() {
#ifdef TARN_PACKAGE_DATA
    return TARN_PACKAGE_DATA;
#else
    return {};
#endif
}

struct EngineOptions {
    // Null: the engine makes a context of its own without a window, by EGL. Else it draws in the context that
    // is current on this thread, which must be OpenGL 4.5 core and current again at every later call of the
    // engine and its views, their destructors included.
    GlLoader gl_loader = nullptr;
    int threads = 0;  // worker threads of ray tracing, and of a GL driver on the CPU; 0: one per core
    // Holds the folder shaders/ where it is neither named by the environment variable TARN_SHADER_DIR, nor
    // beside the program, nor in ../share/tarn seen from the program.
    std::filesystem::path data_folder = package_data_folder();
};

// The GL context and what all views share. One thread's.
class Engine {
  public:
    // Error where there is no OpenGL 4.5 core, or no shaders.
    explicit Engine(const EngineOptions& options = {});
    Engine(Engine&& other) noexcept;
    Engine& operator=(Engine&& other) noexcept;
    ~Engine();

    // What draws, as its driver says: "llvmpipe (LLVM 15.0.6, 256 bits)".
    const std::string& device_name() const;

  private:
    friend class View;
    std::shared_ptr<struct EngineState> state_;
};

// One frame. The same scene, moment, frame, seed and settings give the same picture, bit for bit, as long as
// the frames before it were the same too.
struct Frame {
    Camera camera;
    std::uint32_t number = 0;  // where it is one more than the last frame's, samples of that frame are reused
    std::uint32_t seed = 0;    // of all random numbers
    Settings settings;
    Display display;
    // The picture is the mean of this frame and of those before it, one after the other, that ask for it too;
    // a move of camera or scene starts over. While they are few, the picture before them shines through.
    bool average = false;
};

// A scene as seen at one size. Keeps the last frame, from which the next one reuses samples. It keeps engine
// and scene alive. In a borrowed context, calls leave the caller's GL state as they found it, but for texture
// units, image units and indexed buffer bindings.
class View {
  public:
    // Error where the scene does not fit the device's limits, or the size is not 1 to 16384 pixels a side.
    View(const Engine& engine, const Scene& scene, int width_px, int height_px);
    View(View&& other) noexcept;
    View& operator=(View&& other) noexcept;
    ~View();

    int width_px() const;
    int height_px() const;

    // Renders a frame and reads it back. Error for a display view that there is not.
    Picture render(const Frame& frame);

    // Renders a frame that stays on the device, and makes it ready to be shown: for windows.
    FrameReport draw(const Frame& frame);

    // Of the last frame; Error before the first one.
    // Reads the radiance back.
    Picture read() const;
    // The name of a GL texture, RGBA8, row 0 on top: the frame as its Display says, for the eye (sRGB). Valid
    // until the next frame.
    unsigned texture() const;
    // Draws that over the whole of the current draw framebuffer, whose size it is given. Error in a context
    // of the engine's own, which has no window.
    void present(int framebuffer_width_px, int framebuffer_height_px);
    // Writes that with 8 bits a channel. The file is written whole or not at all. Error that names it.
    void write_png(const std::filesystem::path& file) const;
    // The exposure in EV with which it is shown. Waits for the device.
    float exposure_ev() const;

    // Forgets the last frame, as after a cut.
    void reset_history();

    // Reads the shader files again that have changed. What is wrong with those that do not compile and keep
    // their old version; empty: nothing.
    std::string reload_shaders();

  private:
    std::unique_ptr<struct ViewState> state_;
};

}  // namespace tarn::api
