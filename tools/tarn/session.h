// A renderer with all that it needs, set up from the command line's options.
#pragma once

#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "core/display.h"
#include "output/output_files.h"
#include "platform/context.h"
#include "renderer/renderer.h"
#include "scene_options.h"

namespace tarn {

struct RenderOptions {
    SceneOptions scene;
    RenderSettings settings;
    std::string preset = "clean";  // that the settings started from; "raw": none
    bool names_preset = false;     // whether the user chose that
    std::string context = "egl";
    std::optional<float> exposure_ev;  // none: automatic
    DisplayLook look = {ToneCurve::NEUTRAL, 1.0f};
    std::string json_file;
};

// Adds the options of the scene, --context, --exposure and --json: for commands whose methods bring their own
// settings.
void add_session_options(CLI::App& command, RenderOptions& options);

// Adds those, --preset and an option for each row of the settings table.
void add_render_options(CLI::App& command, RenderOptions& options);

// Adds these for a command that shows pictures to people: the preset "clean" unless --raw or --preset say
// otherwise, and --tone, --glare and --glare-strength.
void add_picture_options(CLI::App& command, RenderOptions& options);

// The context that the options ask for.
ContextOptions make_context_options(const RenderOptions& options);

class RenderSession {
  public:
    explicit RenderSession(const RenderOptions& options, const SceneEdit& edit = {});

    // Moves scene, rays and buffers to `time_s`.
    void move_to(double time_s);

    Renderer& renderer() { return *renderer_; }
    const RayTracer& tracer() const { return *tracer_; }
    const LoadedScene& loaded() const { return loaded_; }
    LoadedScene& loaded() { return loaded_; }
    const Context& context() const { return *context_; }

    // What the machine is: CPU, threads, driver, Embree.
    nlohmann::json describe_machine() const;

  private:
    WorkerLimit workers_;
    LoadedScene loaded_;
    std::unique_ptr<Context> context_;
    std::unique_ptr<RayTracer> tracer_;
    std::unique_ptr<Renderer> renderer_;
    int threads_;
};

// Sums over the frames of a run, for the report.
struct RunTotals {
    TimingLog timings;
    std::uint64_t shadow_rays = 0;
    std::uint64_t closest_rays = 0;
    int frames = 0;

    // Counts a frame. The first one's time holds the compilation of shaders: it goes once there is a second.
    void add(const FrameOutput& output);
};

// The JSON report of render and flythrough: frame_ms, passes, rays, counters, machine, settings, plan.
nlohmann::json make_report(const RenderOptions& options, RenderSession& session, const RunTotals& totals);

}  // namespace tarn
