#include "passes/indirect/reuse.h"

#include "passes/reuse/boiling_filter.h"
#include "passes/reuse/spatial.h"
#include "passes/reuse/temporal.h"
#include "shared/math/path_sample.h"

namespace tarn {

Samples reuse_indirect_over_time(const FrameContext& frame, const ReuseInput& input,
                                 const Previous<KeptSamples>& previous) {
    using Variant = IndirectTemporalVariant;
    const ReusePlan& plan = frame.plan.indirect.reuse;
    const ReuseShaders shaders{
        Variant::PATH,
        [&](ReuseRun run) -> const Program& { return frame.compute(Variant{{plan.variant(run)}}); },
        PATH_SAMPLE_ROWS};
    return reuse_over_time(frame, shaders, plan, frame.settings.indirect.reuse, input, previous);
}

Samples filter_indirect_boiling(const FrameContext& frame, Samples samples) {
    using Variant = IndirectBoilingFilterVariant;
    const ReuseShaders shaders{Variant::PATH,
                               [&](ReuseRun) -> const Program& { return frame.compute(Variant{}); },
                               PATH_SAMPLE_ROWS};
    return filter_boiling(frame, shaders, frame.settings.indirect.reuse, std::move(samples));
}

Samples reuse_indirect_over_space(const FrameContext& frame, const ReuseInput& input, int iteration) {
    using Variant = IndirectSpatialVariant;
    const ReusePlan& plan = frame.plan.indirect.reuse;
    const ReuseShaders shaders{Variant::PATH,
                               [&](ReuseRun run) -> const Program& {
                                   return frame.compute(Variant{{plan.variant(run), plan.neighbours}});
                               },
                               PATH_SAMPLE_ROWS};
    return reuse_over_space(frame, shaders, plan, frame.settings.indirect.reuse, input, iteration);
}

}  // namespace tarn
