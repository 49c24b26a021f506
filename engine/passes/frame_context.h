// What every pass knows of the frame at hand.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <string>

#include "frame/frame_recorder.h"
#include "gl/program_library.h"
#include "plan/frame_plan.h"
#include "rays/ray_tracer.h"

namespace tarn {

// Rays of a frame, rejected ones of both kinds together.
struct RayCounts {
    RayBatchResult shadow;
    std::uint64_t closest = 0;
    std::uint64_t camera = 0;
};

struct FrameContext {
    FrameRecorder& recorder;
    ProgramLibrary& programs;
    const RayTracer& tracer;
    const Buffer& counters;
    RayCounts& rays;
    const FramePlan& plan;
    const RenderSettings& settings;
    const Defines& scene_defines;  // of all shaders that know the scene: its features, and what tests plant
    glm::ivec2 size_px;            // of the surfaces and their light
    glm::ivec2 output_px;          // of the picture
    glm::vec2 jitter_px{0.0f};     // where in a pixel its ray goes through, from the centre
    std::uint32_t frame = 0;
    std::uint32_t seed = 0;
    // How the last frame's rays were answered; none: no history is valid.
    std::optional<PreviousRays> previous = std::nullopt;
    bool has_moved = false;      // camera, lights or geometry, since the last frame
    bool scene_changed = false;  // lights, geometry or materials, since the last frame
    bool paths_may_be_stale =
        false;  // the scene changed since kept path samples were last asked for their lamps

    PassRecorder pass(const std::string& name) const { return recorder.pass(name); }

    // The compiled shader of a variant (plan/shader_variants.h).
    template <class Variant>
    const Program& compute(const Variant& variant) const {
        Defines defines = defines_of(variant);
        if (has_row_groups()) defines.push_back("TARN_ROW_GROUPS");
        return programs.compute(Variant::PATH, defines);
    }
    template <class Variant>
    const Program& graphics(const Variant& variant) const {
        return programs.graphics(Variant::PATH, defines_of(variant));
    }

    std::size_t pixel_count() const { return std::size_t(size_px.x) * std::size_t(size_px.y); }

    // Memory for `rows` rows of four words a pixel. Error where a storage block of the driver cannot hold
    // them.
    Rows take_pixel_rows(const std::string& name, std::size_t rows, BufferUse use) const;

  private:
    // Whether work groups are rows of pixels (shaders/lib/pixel_group.glsl).
    bool has_row_groups() const;

    template <class Variant>
    Defines defines_of(const Variant& variant) const {
        Defines defines = variant.defines();
        if (Variant::IS_OF_SCENE) defines.insert(defines.begin(), scene_defines.begin(), scene_defines.end());
        return defines;
    }
};

}  // namespace tarn
