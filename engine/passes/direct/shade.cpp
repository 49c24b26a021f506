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

ReflectedLight shade_direct(const FrameContext& frame, const GBuffer& gbuffer, const SampleSlot& slot,
                            const ShadeInput& input, const ReflectedLight& earlier) {
    const DirectPlan& plan = frame.plan.direct;
    const ShadeVariant variant{source_of(input), plan.view, plan.targets.size() > 1, bool(earlier)};
    const ReflectedLight light = earlier ? earlier : take_reflected_light(frame, "direct/light");
    ShadeConstants constants;
    constants.target_weights = glm::vec4(slot.target_weights, 0.0f);
    constants.share = 1.0f / float(plan.sample_count);
    PassRecorder pass = frame.pass("direct/shade");
    read_gbuffer(pass, gbuffer).constants(constants);
    if (input.summed) {
        pass.read(UNIT_PASS_A, input.summed.diffuse).read(UNIT_PASS_B, input.summed.specular);
    } else {
        pass.read(UNIT_PASS_A, input.samples->reservoirs);
    }
    if (input.answers) pass.read(UNIT_PASS_B, input.answers);
    if (earlier) {
        pass.read_write_image(0, *light.diffuse).read_write_image(1, *light.specular);
    } else {
        pass.write_image(0, *light.diffuse).write_image(1, *light.specular);
    }
    pass.dispatch(frame.compute(variant), frame.size_px);
    return light;
}

}  // namespace tarn
