// The viewer: a window on a scene, a fly camera, and the panel.
#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "fly_camera.h"
#include "overlay.h"
#include "panel.h"
#include "recent_timings.h"
#include "rest_watch.h"
#include "tarn_names.h"
#include "window.h"

namespace game {

struct ViewerOptions {
    std::string scene_name;        // in the title and on the panel
    std::optional<Camera> camera;  // to start from; nullopt: the scene's first, and with it where it moves
    Settings settings;
    std::string preset = "clean";      // from which they come
    std::string view = "radiance";     // which display view
    std::optional<float> exposure_ev;  // nullopt: automatic
    std::string tone = "neutral";      // which tone curve
    double glare_strength = 1.0;
    std::uint32_t seed = 0;
    double time_s = -1.0;              // for which the scene was loaded; < 0: its animations play
    int threads = 0;                   // as for EngineOptions
    int frames = 0;                    // quit after so many; 0: never
    std::filesystem::path screenshot;  // written before quitting; empty: none
    std::function<bool()> stop;        // asked before each frame; true: quit. Empty: never
};

class Viewer {
  public:
    // Draws in the window, which must outlive it. Error where its OpenGL does not do.
    Viewer(Window& window, Scene scene, const ViewerOptions& options);

    // Shows frames until the user closes the window or presses Escape, the frames are done or `stop` says so.
    void run();

  private:
    using Clock = std::chrono::steady_clock;

    void collect_scene_facts();
    void make_view(const Size& size);
    void follow_window_size();
    void show_frame(double dt_s);
    void handle_input(const ViewerInput& input, double dt_s);
    void move_scene(double dt_s);
    void follow_camera(std::size_t index);
    FrameReport draw_frame(double dt_s);
    void collect_facts(FrameReport report, double dt_s);
    void apply_panel();
    void update_title();
    void reload_shaders();
    void save_screenshot();
    void report(const std::string& message, bool is_error);

    ViewerOptions options_;
    Window& window_;
    Engine engine_;
    Scene scene_;
    Overlay overlay_;
    std::unique_ptr<View> view_;

    ViewerState state_;
    ViewerFacts facts_;
    RecentTimings timings_;
    RestWatch rest_;
    FlyCamera camera_;
    std::uint32_t frame_ = 0;
    bool has_picture_ = false;   // of the view's
    double loop_s_ = 0.0;        // from frame to frame, smoothed
    double posed_time_s_ = 0.0;  // what the scene shows; state_.time_s is what it should
    Size failed_size_;           // the driver refused it
    Size wanted_size_;           // and since when
    Clock::time_point wanted_since_;
    Clock::time_point titled_at_;
    Clock::time_point reported_at_;
};

}  // namespace game
