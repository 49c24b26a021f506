#include "passes/direct/direct_light.h"

#include "gl/handle.h"
#include "shared/interface/bindings.h"
#include "shared/math/reservoir.h"

namespace tarn {
namespace {

// Size of a table with `rows` rows a pixel. Error where a driver's storage block cannot hold it.
std::size_t rows_size_bytes(int width_px, int height_px, std::size_t rows) {
    const std::size_t pixel_bytes = rows * sizeof(glm::uvec4);
    const std::size_t limit = std::size_t(get_gl_limit(GL_MAX_SHADER_STORAGE_BLOCK_SIZE)) / pixel_bytes;
    const std::size_t pixels = std::size_t(width_px) * std::size_t(height_px);
    if (pixels > limit) {
        throw Error("a picture of {} x {} has {} pixels, the driver's storage blocks hold {}", width_px,
                    height_px, pixels, limit);
    }
    return pixels * pixel_bytes;
}

}  // namespace

DirectCandidatesPass::DirectCandidatesPass(ProgramLibrary& programs, int width_px, int height_px)
    : programs_(programs),
      width_px_(width_px),
      height_px_(height_px),
      reservoirs_("direct/reservoirs", rows_size_bytes(width_px, height_px, RESERVOIR_ROWS),
                  BufferUse::DEVICE),
      reservoir_texture_("direct/reservoirs", reservoirs_, GL_RGBA32UI),
      rays_("direct/rays", rows_size_bytes(width_px, height_px, RAY_ROWS), BufferUse::SHARED) {}

Candidates DirectCandidatesPass::record(FrameRecorder& frame, const GBuffer& gbuffer, DirectMode mode,
                                        const Buffer& counters,
                                        const std::vector<std::string>& scene_defines) {
    std::vector<std::string> defines = scene_defines;
    defines.push_back(mode == DirectMode::UNIFORM ? "TARN_DIRECT_UNIFORM" : "TARN_DIRECT_RIS");
    PassRecorder pass = frame.pass("direct/candidates");
    read_gbuffer(pass, gbuffer)
        .write(0, reservoirs_)
        .write(1, rays_)
        .count(BLOCK_COUNTERS, counters)
        .dispatch(programs_.compute("direct/candidates", defines), width_px_, height_px_);
    return {reservoirs_, reservoir_texture_, rays_};
}

DirectShadePass::DirectShadePass(ProgramLibrary& programs, int width_px, int height_px)
    : programs_(programs),
      width_px_(width_px),
      height_px_(height_px),
      radiance_("direct/radiance", width_px, height_px, GL_RGBA32F) {}

const Texture2D& DirectShadePass::record(FrameRecorder& frame, const GBuffer& gbuffer,
                                         const Candidates& candidates, const Visibility& visibility,
                                         const Buffer& counters,
                                         const std::vector<std::string>& scene_defines) {
    PassRecorder pass = frame.pass("direct/shade");
    read_gbuffer(pass, gbuffer)
        .read(UNIT_EMISSION, gbuffer.emission)
        .read(UNIT_PASS_A, candidates.reservoir_texture, candidates.reservoirs)
        .read(UNIT_PASS_B, visibility.texture, visibility.answers)
        .write_image(0, radiance_)
        .count(BLOCK_COUNTERS, counters)
        .dispatch(programs_.compute("direct/shade", scene_defines), width_px_, height_px_);
    return radiance_;
}

}  // namespace tarn
