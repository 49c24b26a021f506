// THE FRAME: from a world, a camera and settings to radiance, pass by pass.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/image.h"
#include "frame/frame_recorder.h"
#include "gl/program_library.h"
#include "passes/gbuffer.h"
#include "passes/gpu_light_tree.h"
#include "passes/gpu_scene.h"
#include "plan/frame_plan.h"
#include "rays/ray_tracer.h"
#include "renderer/direct_light.h"
#include "renderer/settings.h"

namespace tarn {

struct FrameInput {
    CameraRecord camera;
    std::uint32_t frame = 0;
    std::uint32_t seed = 0;
    RenderSettings settings;
};

struct FrameOutput {
    const Texture2D& radiance;  // RGBA32F, row 0 on top, W sr^-1 m^-2
    GBuffer gbuffer;
    FrameTimings timings;
    RayBatchResult shadow_rays;
    std::uint64_t closest_rays = 0;
    GBufferStatistics raster;
};

// Needs a current GL context. Same world, camera, frame, seed and settings give the same bits.
class Renderer {
  public:
    // Throws Error when the world does not fit the driver's limits. Any number of renderers may look at one
    // world, each when it likes. `world` and `tracer` must outlive the renderer. `extra_defines` reach every
    // shader: tests plant mistakes with them (TARN_PLANT_*).
    Renderer(const World& world, const RayTracer& tracer, int width_px, int height_px,
             std::vector<std::string> extra_defines = {});

    // Uploads what moved; call after update_world and the tracer's update.
    void update();

    // Looks back to the last frame where this one follows it (`input.frame` is one more), else starts anew.
    FrameOutput render(const FrameInput& input);

    // Forgets the last frame, as after a cut.
    void reset_history() { last_frame_.reset(); }

    // Waits and reads a radiance texture back as 3 channels.
    Image read_radiance(const Texture2D& radiance) const;

    // Totals since construction, by name.
    std::map<std::string, std::uint64_t> read_counters() const;

    // Recompiles changed shaders; returns the errors of those that keep their old version.
    std::string reload_shaders() { return programs_.reload(); }

    const FramePlan& plan() const { return plan_; }
    int width_px() const { return width_px_; }
    int height_px() const { return height_px_; }

  private:
    void update_plan();
    void update_light_tree_for(const RenderSettings& settings);
    void upload_frame_block(const FrameInput& input);
    void advance(const FrameInput& input);

    const World& world_;
    const RayTracer& tracer_;
    int width_px_;
    int height_px_;
    PlanHistory planned_history_;
    FramePlan plan_;
    std::vector<std::string> extra_defines_;
    std::vector<std::string> defines_;
    std::uint64_t planned_lights_;  // order of the lights that the plan saw
    std::uint64_t planned_materials_;
    ProgramLibrary programs_;
    GpuScene gpu_scene_;
    LightTree light_tree_;  // once settings draw from it
    GpuLightTree gpu_light_tree_;
    FrameRecorder frame_;
    Buffer frame_block_;
    Buffer counters_;
    GBufferPass gbuffer_;
    DirectLight direct_light_;
    std::optional<PreviousRays> last_frame_;  // which it was; none: there is nothing to look back at
    CameraRecord last_camera_{};
    std::uint64_t rejected_rays_ = 0;
};

}  // namespace tarn
