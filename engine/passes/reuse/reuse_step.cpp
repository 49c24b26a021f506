#include "passes/reuse/reuse_step.h"

#include <algorithm>

#include "core/error.h"
#include "gl/handle.h"
#include "passes/trace_rays.h"
#include "shared/interface/bindings.h"
#include "shared/interface/records.h"
#include "shared/math/reservoir.h"

namespace tarn {
namespace {

constexpr std::size_t RAY_BYTES = RAY_ROWS * sizeof(glm::uvec4);
constexpr int GROUP_PX = 8;

struct Band {
    int begin;
    int end;
};

// A multiple of the group's height, so that no two bands share a group.
int rows_per_band(const glm::ivec2& size_px, std::uint32_t rays_per_pixel) {
    if (rays_per_pixel == 0) return size_px.y;
    const std::size_t limit = std::size_t(get_gl_limit(GL_MAX_SHADER_STORAGE_BLOCK_SIZE)) / RAY_BYTES;
    const std::size_t rows = limit / (std::size_t(size_px.x) * rays_per_pixel) / GROUP_PX * GROUP_PX;
    if (rows == 0) {
        throw Error(
            "reuse asks for {} rays for each of {} pixels in a row, the driver's storage blocks hold {}",
            rays_per_pixel, size_px.x, limit);
    }
    return int(std::min(rows, std::size_t(size_px.y)));
}

ReuseRun merge_run(const ReuseInput& input) {
    if (input.light != nullptr) return ReuseRun::MERGE_AND_SHADE;
    return input.tests_samples ? ReuseRun::MERGE_AND_TEST : ReuseRun::MERGE;
}

ReuseConstants constants_for(const ReuseKernel& kernel, const ReuseInput& input, const Band& band) {
    ReuseConstants constants = kernel.constants;
    constants.target_weights = input.slot.target_weights;
    constants.band_begin = band.begin;
    constants.band_end = band.end;
    constants.rays_per_pixel = kernel.rays_per_pixel;
    return constants;
}

// The rays that the weights ask for, and their answers.
Answers ask(const FrameContext& frame, const ReuseKernel& kernel, const ReuseInput& input, const Band& band,
            const Rows& rays) {
    {
        PassRecorder pass = frame.pass(kernel.shaders.name + "_rays");
        kernel.read(pass);
        read_gbuffer(pass, input.gbuffer)
            .read(UNIT_PASS_A, input.samples.reservoirs)
            .constants(constants_for(kernel, input, band))
            .write(1, rays)
            .count(BLOCK_COUNTERS, frame.counters)
            .dispatch(kernel.shaders.program(ReuseRun::WRITE_RAYS), {frame.size_px.x, band.end - band.begin});
    }
    const std::size_t count =
        std::size_t(band.end - band.begin) * std::size_t(frame.size_px.x) * kernel.rays_per_pixel;
    return trace_visibility(frame, kernel.shaders.name + "_visibility", rays, count, input.slot.shadow_key);
}

void merge(const FrameContext& frame, const ReuseKernel& kernel, const ReuseInput& input, const Band& band,
           const Answers& answers, const Samples& merged) {
    PassRecorder pass = frame.pass(kernel.shaders.name);
    kernel.read(pass);
    read_gbuffer(pass, input.gbuffer)
        .read(UNIT_PASS_A, input.samples.reservoirs)
        .constants(constants_for(kernel, input, band))
        .write(0, merged.reservoirs);
    if (answers) pass.read(UNIT_PASS_B, answers);
    if (merged.rays) pass.write(2, merged.rays);
    if (input.light != nullptr) {
        pass.write_image(0, *input.light->diffuse).write_image(1, *input.light->specular);
    }
    pass.count(BLOCK_COUNTERS, frame.counters)
        .dispatch(kernel.shaders.program(merge_run(input)), {frame.size_px.x, band.end - band.begin});
}

}  // namespace

Samples run_reuse_step(const FrameContext& frame, const ReuseKernel& kernel, const ReuseInput& input) {
    Samples merged;
    merged.reservoirs = frame.take_pixel_rows(kernel.shaders.name,
                                              RESERVOIR_ROWS + kernel.shaders.sample_rows, BufferUse::DEVICE);
    if (input.tests_samples) merged.rays = frame.take_pixel_rows("shadow_rays", RAY_ROWS, BufferUse::SHARED);
    const int rows = rows_per_band(frame.size_px, kernel.rays_per_pixel);
    const std::size_t capacity = std::size_t(rows) * std::size_t(frame.size_px.x) * kernel.rays_per_pixel;
    Rows rays;
    if (capacity > 0) rays = frame.recorder.take_rows("reuse_rays", capacity * RAY_BYTES, BufferUse::SHARED);
    for (int begin = 0; begin < frame.size_px.y; begin += rows) {
        const Band band{begin, std::min(begin + rows, frame.size_px.y)};
        const Answers answers = rays ? ask(frame, kernel, input, band, rays) : nullptr;
        merge(frame, kernel, input, band, answers, merged);
    }
    return merged;
}

}  // namespace tarn
