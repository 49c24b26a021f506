#include "passes/reuse/initial_visibility.h"

#include "shared/interface/bindings.h"
#include "shared/interface/constants/initial_visibility.h"

namespace tarn {

Samples apply_initial_visibility(const FrameContext& frame, const ReuseShaders& shaders,
                                 const ReusePlan& plan, Samples fresh, const Answers& answers) {
    frame.pass(shaders.name)
        .constants(InitialVisibilityConstants{plan.drops_occluded ? 1u : 0u})
        .read(UNIT_PASS_A, answers)
        .read_write(0, fresh.reservoirs)
        .dispatch(shaders.program(ReuseRun::MERGE), frame.size_px);
    return fresh;
}

}  // namespace tarn
