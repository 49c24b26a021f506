#include "passes/average.h"

#include <cmath>

#include "shared/interface/bindings.h"
#include "shared/interface/constants/average.h"

namespace tarn {
namespace {

constexpr int ERROR_GROUPS = 16;

Rows sum_error(const FrameContext& frame, const AveragedFrames& averaged) {
    const Rows sums = frame.recorder.take_rows(
        "average/error", std::size_t(ERROR_GROUPS) * 64 * sizeof(glm::uvec4), BufferUse::DEVICE);
    frame.pass("average/error")
        .constants(AverageConstants{averaged.frames, 0u})
        .read(UNIT_PASS_A, averaged.mean)
        .write(0, sums)
        .dispatch(frame.compute(AverageErrorVariant{}), {8 * ERROR_GROUPS, 8});
    return sums;
}

}  // namespace

AveragedPicture average_frames(const FrameContext& frame, const Picture& radiance,
                               const std::optional<Previous<AveragedFrames>>& previous,
                               const std::optional<Previous<Picture>>& before) {
    AveragedPicture result;
    AveragedFrames& averaged = result.averaged;
    averaged.mean = frame.recorder.take_picture("average/mean", frame.output_px, GL_RGBA32F);
    if (previous) {
        averaged.frames = previous->value().frames;
        averaged.before = previous->value().before;
    } else if (before) {
        averaged.before = before->value();
    }
    result.shown = frame.recorder.take_picture("average/shown", frame.output_px, GL_RGBA32F);
    PassRecorder pass = frame.pass("average/add");
    pass.constants(AverageConstants{averaged.frames, averaged.before ? 1u : 0u})
        .read(UNIT_PASS_A, radiance)
        .write_image(0, *averaged.mean)
        .write_image(1, *result.shown);
    if (previous) pass.read(UNIT_PASS_B, *previous, previous->value().mean);
    if (previous && averaged.before) pass.read(UNIT_PASS_C, *previous, *averaged.before);
    if (!previous && before) pass.read(UNIT_PASS_C, *before, before->value());
    pass.dispatch(frame.compute(AverageVariant{}), frame.output_px);
    ++averaged.frames;
    if (averaged.frames > 1) result.sums = sum_error(frame, averaged);
    return result;
}

double find_relative_error(const Rows& sums) {
    if (!sums) return 0.0;
    double variance = 0.0, light = 0.0;
    std::size_t pixels = 0;
    for (const glm::uvec4& sum : sums->buffer().download<glm::uvec4>()) {
        variance += double(glm::uintBitsToFloat(sum.x));
        light += double(glm::uintBitsToFloat(sum.y));
        pixels += sum.z;
    }
    return light > 0.0 ? std::sqrt(variance * double(pixels)) / light : 0.0;
}

}  // namespace tarn
