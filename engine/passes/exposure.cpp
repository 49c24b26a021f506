#include "passes/exposure.h"

#include <cmath>

#include "shared/interface/bindings.h"
#include "shared/interface/constants/exposure.h"
#include "shared/math/exposure.h"

namespace tarn {
namespace {

// [group][bin]
Rows count_brightness(const FrameContext& frame, const Picture& radiance) {
    const glm::ivec2 groups(8 * EXPOSURE_GROUPS, 8);
    const Rows counts =
        frame.recorder.take_rows("exposure/count", EXPOSURE_GROUPS * EXPOSURE_BINS * sizeof(std::uint32_t),
                                 BufferUse::DEVICE, GL_R32UI);
    frame.pass("exposure/count")
        .read(UNIT_PASS_A, radiance)
        .write(0, counts)
        .dispatch(frame.compute(ExposureCountVariant{}), groups);
    return counts;
}

}  // namespace

Exposure find_exposure(const FrameContext& frame, const Picture& radiance, const ExposureInput& input,
                       const std::optional<Previous<Exposure>>& previous) {
    const glm::ivec2 one_group(8, 8);
    const Exposure exposure = frame.recorder.take_rows("exposure", sizeof(glm::uvec4), BufferUse::DEVICE);
    ExposureConstants constants;
    constants.step_share = float(1.0 - std::exp(-input.elapsed_s / EXPOSURE_TIME_S));
    constants.fixed_ev = input.fixed_ev.value_or(0.0f);
    constants.fixed_scale = std::exp2(constants.fixed_ev);
    constants.is_fixed = input.fixed_ev ? 1u : 0u;
    constants.tone = std::uint32_t(input.tone);
    constants.has_previous = previous ? 1u : 0u;
    const Rows counts = input.fixed_ev ? nullptr : count_brightness(frame, radiance);
    PassRecorder pass = frame.pass("exposure/find");
    pass.constants(constants).write(0, exposure);
    if (counts) pass.read(UNIT_PASS_A, counts);
    if (previous) pass.read(UNIT_PASS_B, *previous, previous->value());
    pass.dispatch(frame.compute(ExposureVariant{}), one_group);
    return exposure;
}

}  // namespace tarn
