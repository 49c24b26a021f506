#include "passes/composite.h"

#include "shared/interface/bindings.h"

namespace tarn {

Picture composite(const FrameContext& frame, const GBuffer& gbuffer, const ReflectedLight& direct,
                  const ReflectedLight& indirect) {
    const Picture radiance = frame.recorder.take_picture("composite", frame.size_px, GL_RGBA32F);
    PassRecorder pass = frame.pass("composite");
    read_gbuffer(pass, gbuffer)
        .read(UNIT_PASS_A, direct.diffuse)
        .read(UNIT_PASS_B, direct.specular)
        .write_image(0, *radiance)
        .count(BLOCK_COUNTERS, frame.counters);
    if (indirect) pass.read(UNIT_PASS_C, indirect.diffuse).read(UNIT_PASS_D, indirect.specular);
    pass.dispatch(frame.compute(frame.plan.composite), frame.size_px);
    return radiance;
}

}  // namespace tarn
