#include "passes/direct/shade.h"

#include "shared/interface/bindings.h"
#include "shared/interface/constants/shade.h"

namespace tarn {

ReflectedLight shade_direct(const FrameContext& frame, const GBuffer& gbuffer, const SampleSlot& slot,
                            const ShadeInput& input, const ReflectedLight& earlier) {
    const DirectPlan& plan = frame.plan.direct;
    const ShadeVariant variant{source_of(input), plan.view, plan.targets.size() > 1, bool(earlier)};
    const ReflectedLight light = earlier ? earlier : take_reflected_light(frame, "direct/light");
    ShadeConstants constants;
    constants.target_weights = slot.target_weights;
    constants.share = 1.0f / float(plan.sample_count);
    PassRecorder pass = frame.pass("direct/shade");
    read_gbuffer(pass, gbuffer).constants(constants);
    read_shade_input(pass, input);
    write_light(pass, light, bool(earlier));
    pass.dispatch(frame.compute(variant), frame.size_px);
    return light;
}

}  // namespace tarn
