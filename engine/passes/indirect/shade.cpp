#include "passes/indirect/shade.h"

#include "shared/interface/bindings.h"
#include "shared/interface/constants/shade.h"

namespace tarn {

ReflectedLight shade_indirect(const FrameContext& frame, const GBuffer& gbuffer, const SampleSlot& slot,
                              const Samples& samples, const Answers& answers) {
    const ReflectedLight light = take_reflected_light(frame, "indirect/light");
    PassRecorder pass = frame.pass("indirect/shade");
    read_gbuffer(pass, gbuffer)
        .constants(ShadeConstants{glm::vec4(slot.target_weights, 0.0f), 1.0f})
        .read(UNIT_PASS_A, samples.reservoirs)
        .write_image(0, *light.diffuse)
        .write_image(1, *light.specular);
    if (answers) pass.read(UNIT_PASS_B, answers);
    pass.dispatch(frame.compute(IndirectShadeVariant{!answers}), frame.size_px);
    return light;
}

}  // namespace tarn
