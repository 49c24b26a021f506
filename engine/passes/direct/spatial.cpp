#include "passes/direct/spatial.h"

#include "shared/math/mis.h"

namespace tarn {

void SpatialPass::record(const DirectFrame& direct, const ReuseStep::Io& io, int iteration) {
    const DirectSettings& settings = direct.settings;
    const std::uint32_t rays =
        reuse_ray_count(std::uint32_t(settings.mis), settings.mis_visibility,
                        settings.visibility != SampleVisibility::TRACE, std::uint32_t(settings.neighbours));
    step_.record(direct, "direct/spatial", rays, io, [&](PassRecorder&, const Program& program) {
        program.set("neighbour_count", unsigned(settings.neighbours));
        program.set("radius_px", float(settings.radius_px));
        program.set("iteration", unsigned(iteration));
        program.set("mirror", settings.mirror ? 1u : 0u);
    });
}

}  // namespace tarn
