// Draws frames of a world. THE FRAME itself, stage by stage, is in frame.cpp.
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
#include "passes/denoise/denoise.h"
#include "passes/display.h"
#include "passes/exposure.h"
#include "passes/frame_context.h"
#include "passes/gbuffer.h"
#include "passes/gpu_light_tree.h"
#include "passes/gpu_scene.h"
#include "passes/indirect/paths.h"
#include "passes/reflected_light.h"
#include "plan/frame_plan.h"
#include "rays/ray_tracer.h"
#include "renderer/frame_history.h"
#include "settings/settings.h"
#include "shared/interface/frame_block.h"

namespace tarn {

// What a frame shows besides its radiance.
struct DisplayInput {
    DisplayChoice choice;
    ExposureInput exposure;
};

struct FrameInput {
    CameraRecord camera;
    std::uint32_t frame = 0;
    std::uint32_t seed = 0;
    RenderSettings settings;
    // Where in a pixel its ray goes through, from the centre, pixels; within +-0.5 pixels stay what they are.
    // Added to where antialiasing samples.
    glm::vec2 jitter_px{0.0f};
    bool average =
        false;  // radiance and display are the mean of this frame and those before it that say so too
    std::optional<DisplayInput> display = std::nullopt;  // none: nothing is shown
};

struct FrameOutput {
    const Texture2D& radiance;  // RGBA32F, row 0 on top, W sr^-1 m^-2; until the next frame
    Picture display;            // RGBA8: exposed, tone-mapped, sRGB; null: nothing is shown
    GBuffer gbuffer;
    FrameTimings timings;
    RayBatchResult shadow_rays;
    std::uint64_t closest_rays = 0;
    std::uint64_t camera_rays = 0;
    GBufferStatistics raster;
};

// Needs a current GL context. Same world, camera, frame, seed and settings give the same bits.
class Renderer {
  public:
    // Throws Error when the world does not fit the driver's limits. Any number of renderers may look at one
    // world, each when it likes. `world` and `tracer` must outlive the renderer. `extra_defines` reach every
    // shader of the scene: tests plant mistakes with them (TARN_PLANT_*). The size is that of the pictures;
    // the settings may render less (AntialiasSettings::scale).
    Renderer(const World& world, const RayTracer& tracer, int width_px, int height_px,
             Defines extra_defines = {});

    // Uploads what moved; call after update_world and the tracer's update.
    void update();

    // Reuses the last frame if this one follows it (`input.frame` is one more), else starts anew.
    FrameOutput render(const FrameInput& input);

    // Forgets the last frame, as after a cut.
    void reset_history() { history_.forget(); }

    // The exposure that the last shown frame had, EV; 0 before the first one. Waits for the device.
    float read_exposure_ev() const;

    // How many frames the last one's radiance is the mean of, and the error that is left
    // (find_relative_error).
    std::uint32_t averaged_frames() const { return averaged_frames_; }
    double read_relative_error() const { return find_relative_error(average_sums_); }

    // Waits and reads a radiance texture back as 3 channels.
    Image read_radiance(const Texture2D& radiance) const;

    // Totals since construction, by name.
    std::map<std::string, std::uint64_t> read_counters() const;

    // Recompiles changed shaders; returns the errors of those that keep their old version.
    std::string reload_shaders() { return programs_.reload(); }

    // Of the latest frame.
    const FramePlan& plan() const { return plan_; }
    int width_px() const { return output_px_.x; }
    int height_px() const { return output_px_.y; }

  private:
    struct Values {
        GBuffer gbuffer;
        Picture radiance;
        Picture display;
    };

    void survey();
    Values record_frame(const FrameContext& frame, const FrameInput& input);
    ReflectedLight light_directly(const FrameContext& frame, const GBuffer& gbuffer);
    ReflectedLight light_indirectly(const FrameContext& frame, const GBuffer& gbuffer);
    ReflectedLight light_coarsely(const FrameContext& frame, const GBuffer& gbuffer);
    ReflectedLight light_by_paths(const FrameContext& frame, const GBuffer& gbuffer);
    ReflectedLight finish_paths(const FrameContext& frame, const GBuffer& gbuffer, SampleSlot slot,
                                const Paths& paths);
    ReflectedLight reuse_paths(const FrameContext& frame, const GBuffer& gbuffer, const SampleSlot& slot,
                               const Samples& fresh, const ReflectedLight& earlier);
    std::optional<Previous<KeptLight>> find_previous_light(const FrameContext& frame) const;
    std::optional<Previous<KeptSamples>> find_previous_samples(const FrameContext& frame) const;
    Picture compare_light(const FrameContext& frame, const GBuffer& gbuffer,
                          const Previous<KeptSamples>& samples) const;
    ReflectedLight denoise(const FrameContext& frame, const GBuffer& gbuffer, const NoisyLight& noisy);
    Picture average(const FrameContext& frame, const Picture& radiance);
    Picture show(const FrameContext& frame, const DisplayInput& input, const Picture& radiance,
                 const GBuffer& gbuffer);
    Picture finish(const FrameContext& frame, const GBuffer& gbuffer, const AntialiasInput& input);
    void choose_size(const RenderSettings& settings);
    std::uint64_t pixel_count() const { return std::uint64_t(size_px_.x) * std::uint64_t(size_px_.y); }
    glm::vec2 find_jitter_px(const FrameInput& input) const;
    void fit_light_tree();
    const RowBuffer* find_blue_noise();
    const RowBuffer* find_light_tree(bool is_drawn_from) const {
        return is_drawn_from ? gpu_light_tree_.rows() : nullptr;
    }
    FrameBlock make_frame_block(const FrameInput& input) const;
    void upload_frame_blocks(const FrameInput& input);
    bool has_moved(const CameraRecord& camera) const;

    const World& world_;
    const RayTracer& tracer_;
    glm::ivec2 output_px_;
    glm::ivec2 size_px_;  // of what is rendered
    Defines extra_defines_;
    ChangeHistory changes_;
    FeatureSurvey survey_;
    Defines scene_defines_;
    std::uint64_t surveyed_lights_;  // order of the lights that the survey saw
    std::uint64_t surveyed_materials_;
    FramePlan plan_;
    ProgramLibrary programs_;
    GpuScene gpu_scene_;
    LightTree light_tree_;  // once settings draw from it
    GpuLightTree gpu_light_tree_;
    std::optional<Table> blue_noise_;  // once settings draw from it
    FrameRecorder recorder_;
    Buffer frame_block_;
    Buffer coarse_frame_block_;  // of indirect light on a coarse picture
    Buffer counters_;
    GBufferPass gbuffer_;
    Denoiser denoiser_;
    FrameHistory history_;
    Picture radiance_;   // the latest one
    Exposure exposure_;  // that of the latest frame that was shown
    std::uint32_t averaged_frames_ = 1;
    Rows average_sums_;
    std::uint64_t rejected_rays_ = 0;
};

}  // namespace tarn
