// What the passes of direct light have in common: the frame at hand, and tables with rows for each pixel.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <vector>

#include "frame/frame_recorder.h"
#include "gl/program_library.h"
#include "passes/direct/direct_settings.h"
#include "passes/gbuffer.h"
#include "rays/ray_tracer.h"

namespace tarn {

struct DirectFrame {
    FrameRecorder& frame;
    const RayTracer& tracer;
    GBuffer gbuffer;
    const DirectSettings& settings;
    glm::vec3 target_weights;  // of the channels in the target: luminance, or one channel
    const Buffer& counters;
    std::vector<std::string> defines;  // what the scene needs (plan/frame_plan.h)
    CoverageKey shadow_key;
    std::optional<PreviousRays> last_frame;  // how its rays were answered; none: this frame has no history
    bool has_moved = false;                  // camera, lights or geometry, since the last frame
    std::uint32_t sample = 0;                // which of the frame's samples of each pixel
};

// Rows of four words, `rows` of them a pixel, as shaders write and read them. Error where a storage block of
// the driver cannot hold them.
RowBuffer make_pixel_rows(const std::string& name, int width_px, int height_px, std::size_t rows,
                          BufferUse use);

}  // namespace tarn
