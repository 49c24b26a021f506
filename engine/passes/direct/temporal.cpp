#include "passes/direct/temporal.h"

#include <algorithm>

#include "shared/interface/bindings.h"

namespace tarn {

void TemporalPass::record(const DirectFrame& direct, const ReuseStep::Io& io, const Past<RowBuffer>& past,
                          bool has_past) {
    const DirectSettings& settings = direct.settings;
    // One ray each way (RAY_HERE, RAY_THERE in the shader).
    const std::uint32_t rays = has_past && settings.traces_in_mis() ? 2 : 0;
    step_.record(direct, "direct/temporal", rays, io, [&](PassRecorder& pass, const Program& program) {
        program.set("has_past", has_past ? 1u : 0u);
        const double cap = direct.has_moved ? std::min(settings.motion_cap, settings.confidence_cap)
                                            : settings.confidence_cap;
        program.set("confidence_cap", float(cap));
        program.set("age_cap", float(settings.age_cap));
        program.set("permute", settings.permute ? 1u : 0u);
        pass.read(UNIT_PASS_C, past);
        direct.gbuffer.previous.value().stack.bind(UNIT_PREVIOUS_SURFACE);
    });
}

}  // namespace tarn
