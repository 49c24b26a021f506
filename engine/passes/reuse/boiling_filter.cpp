#include "passes/reuse/boiling_filter.h"

#include "shared/interface/bindings.h"
#include "shared/interface/constants/boiling_filter.h"

namespace tarn {

Samples filter_boiling(const FrameContext& frame, const ReuseShaders& shaders, const ReuseSettings& settings,
                       Samples samples) {
    frame.pass(shaders.name)
        .constants(BoilingFilterConstants{float(settings.boiling_filter)})
        .read(UNIT_PASS_A, samples.reservoirs)
        .read_write(0, samples.reservoirs)
        .dispatch(shaders.program(ReuseRun::MERGE), frame.size_px);
    return samples;
}

}  // namespace tarn
