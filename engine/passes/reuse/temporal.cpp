#include "passes/reuse/temporal.h"

#include <algorithm>

#include "core/error.h"
#include "shared/interface/bindings.h"
#include "shared/interface/records.h"

namespace tarn {

Samples reuse_over_time(const FrameContext& frame, const ReuseShaders& shaders, const ReusePlan& plan,
                        const ReuseSettings& settings, const ReuseInput& input,
                        const Previous<KeptSamples>& previous) {
    TARN_ASSERT(input.gbuffer.previous, "reuse over time without the last frame's surfaces");
    const Previous<Surfaces>& surfaces = *input.gbuffer.previous;
    const double cap =
        frame.has_moved ? std::min(settings.motion_cap, settings.confidence_cap) : settings.confidence_cap;
    ReuseKernel kernel;
    kernel.shaders = shaders;
    // One ray each way (RAY_HERE, RAY_PREVIOUS_RECEIVER in the shader), and as many for the light that
    // samples carry.
    kernel.rays_per_pixel = plan.traces_in_mis ? 2 : 0;
    kernel.constants.carried_rays = INVALID_INDEX;
    if (input.tests_carried_light) {
        kernel.constants.carried_rays = kernel.rays_per_pixel;
        kernel.rays_per_pixel += 2;
    }
    kernel.constants.confidence_cap = float(cap);
    kernel.constants.age_cap = float(settings.age_cap);
    kernel.constants.permute = settings.permute ? 1u : 0u;
    kernel.read = [&](PassRecorder& pass) {
        pass.read(UNIT_PASS_C, previous, previous.value().reservoirs)
            .read(UNIT_PREVIOUS_SURFACE, surfaces, surfaces.value()->texels());
    };
    return run_reuse_step(frame, kernel, input);
}

}  // namespace tarn
