#include "passes/direct/shade.h"

#include "shared/interface/bindings.h"
#include "shared/interface/constants/shade.h"

namespace tarn {
namespace {

ShadeSource source_of(const ShadeInput& input) {
    if (input.summed) return ShadeSource::SUMMED;
    return input.answers ? ShadeSource::TRACED : ShadeSource::RESERVOIR;
}

}  // namespace

Picture shade_direct(const FrameContext& frame, const GBuffer& gbuffer, const SampleSlot& slot,
                     const ShadeInput& input, Picture earlier) {
    const DirectPlan& plan = frame.plan.direct;
    const ShadeVariant variant{source_of(input), plan.view, plan.targets.size() > 1, earlier != nullptr};
    const Picture radiance =
        earlier ? earlier : frame.recorder.take_picture("direct/radiance", frame.size_px, GL_RGBA32F);
    ShadeConstants constants;
    constants.target_weights = glm::vec4(slot.target_weights, 0.0f);
    constants.share = 1.0f / float(plan.sample_count);
    PassRecorder pass = frame.pass("direct/shade");
    read_gbuffer(pass, gbuffer).constants(constants);
    if (input.summed) {
        pass.read(UNIT_PASS_A, input.summed);
    } else {
        pass.read(UNIT_PASS_A, input.samples->reservoirs);
    }
    if (input.answers) pass.read(UNIT_PASS_B, input.answers);
    if (earlier) {
        pass.read_write_image(0, *radiance);
    } else {
        pass.write_image(0, *radiance);
    }
    pass.count(BLOCK_COUNTERS, frame.counters).dispatch(frame.compute(variant), frame.size_px);
    return radiance;
}

}  // namespace tarn
