#include "passes/reuse/spatial.h"

#include "shared/math/mis.h"

namespace tarn {

Samples reuse_over_space(const FrameContext& frame, const ReuseShaders& shaders, const ReusePlan& plan,
                         const ReuseSettings& settings, const ReuseInput& input, int iteration) {
    ReuseKernel kernel;
    kernel.shaders = shaders;
    kernel.rays_per_pixel =
        reuse_ray_count(std::uint32_t(plan.mis), plan.mis_visibility,
                        plan.final_visibility != FinalVisibility::TRACED, std::uint32_t(plan.neighbours));
    kernel.constants.radius_px = float(settings.radius_px) / float(plan.step_px);
    kernel.constants.iteration = std::uint32_t(iteration);
    kernel.constants.mirror = settings.mirror ? 1u : 0u;
    return run_reuse_step(frame, kernel, input);
}

}  // namespace tarn
