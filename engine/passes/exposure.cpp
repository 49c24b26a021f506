#include "passes/exposure.h"

#include <cmath>

#include "shared/interface/bindings.h"
#include "shared/interface/constants/exposure.h"

namespace tarn {

Exposure find_exposure(const FrameContext& frame, const Picture& radiance, const ExposureInput& input,
                       const std::optional<Previous<Exposure>>& previous) {
    const glm::ivec2 one_group(8, 8);
    const Exposure exposure = frame.recorder.take_rows("exposure", sizeof(glm::uvec4), BufferUse::DEVICE);
    ExposureConstants constants;
    constants.step_share = float(1.0 - std::exp(-input.elapsed_s / EXPOSURE_TIME_S));
    constants.fixed_ev = input.fixed_ev.value_or(0.0f);
    constants.fixed_scale = std::exp2(constants.fixed_ev);
    constants.is_fixed = input.fixed_ev ? 1u : 0u;
    constants.has_previous = previous ? 1u : 0u;
    PassRecorder pass = frame.pass("exposure");
    pass.constants(constants).read(UNIT_PASS_A, radiance).write(0, exposure);
    if (previous) pass.read(UNIT_PASS_B, *previous, previous->value());
    pass.dispatch(frame.compute(ExposureVariant{}), one_group);
    return exposure;
}

}  // namespace tarn
