// The viewer: a window on a scene, a fly camera, and the panel.
#pragma once

#include <chrono>
#include <memory>
#include <optional>
#include <string>

#include "game/fly_camera.h"
#include "passes/display.h"
#include "platform/context.h"
#include "platform/window.h"
#include "renderer/renderer.h"
#include "session.h"
#include "ui/overlay.h"
#include "ui/panel.h"
#include "ui/recent_timings.h"

namespace tarn {

struct ViewOptions {
    RenderOptions render;
    int resolution_percent = 50;
    int frames = 0;  // quit after so many; 0: never
    DisplayView view = DisplayView::RADIANCE;
    std::filesystem::path screenshot;  // written before quitting; empty: none
};

class Viewer {
  public:
    // Loads the scene and opens the window. Throws Error where there is no display.
    explicit Viewer(const ViewOptions& options);

    // Shows frames until the user closes the window, presses Escape or Ctrl-C, or the frames are done.
    void run();

  private:
    using Clock = std::chrono::steady_clock;

    void collect_scene_facts();
    void make_renderer(const glm::ivec2& size_px);
    void follow_window_size();
    void show_frame(double dt_s);
    void handle_input(const ViewerInput& input, double dt_s);
    void move_scene(double dt_s);
    void follow_camera(std::size_t index);
    FrameOutput render_frame(double dt_s);
    void collect_facts(const FrameOutput& output, double dt_s);
    void apply_panel();
    void update_title();
    void reload_shaders();
    void save_screenshot();
    void write_picture(const std::filesystem::path& file) const;
    void report(const std::string& message, bool is_error);

    ViewOptions options_;
    WorkerLimit workers_;
    LoadedScene loaded_;
    std::unique_ptr<Context> context_;
    Window& window_;
    std::unique_ptr<RayTracer> tracer_;
    Overlay overlay_;
    std::unique_ptr<Renderer> renderer_;
    Picture picture_;  // the last one

    ViewerState state_;
    ViewerFacts facts_;
    RecentTimings timings_;
    FlyCamera camera_;
    std::uint32_t frame_ = 0;
    double loop_s_ = 0.0;           // from frame to frame, smoothed
    double posed_time_s_ = 0.0;     // what the world shows; state_.time_s is what it should
    glm::ivec2 failed_size_px_{0};  // the driver refused it
    glm::ivec2 wanted_size_px_{0};  // and since when
    Clock::time_point wanted_since_;
    Clock::time_point titled_at_;
    Clock::time_point reported_at_;
};

}  // namespace tarn
