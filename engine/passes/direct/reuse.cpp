#include "passes/direct/reuse.h"

#include "passes/reuse/boiling_filter.h"
#include "passes/reuse/spatial.h"
#include "passes/reuse/temporal.h"

namespace tarn {
namespace {

template <class Variant>
ReuseShaders shaders_of(const FrameContext& frame) {
    return {Variant::PATH, [&frame](ReuseRun) -> const Program& { return frame.compute(Variant{}); }};
}

}  // namespace

Samples apply_direct_visibility(const FrameContext& frame, Samples fresh, const Answers& answers) {
    return apply_initial_visibility(frame, shaders_of<InitialVisibilityVariant>(frame),
                                    frame.plan.direct.reuse, std::move(fresh), answers);
}

Samples reuse_direct_over_time(const FrameContext& frame, const ReuseInput& input,
                               const Previous<KeptSamples>& previous) {
    const ReusePlan& plan = frame.plan.direct.reuse;
    const ReuseShaders shaders{TemporalVariant::PATH, [&](ReuseRun run) -> const Program& {
                                   return frame.compute(TemporalVariant{plan.variant(run)});
                               }};
    return reuse_over_time(frame, shaders, plan, frame.settings.direct.reuse, input, previous);
}

Samples filter_direct_boiling(const FrameContext& frame, Samples samples) {
    return filter_boiling(frame, shaders_of<BoilingFilterVariant>(frame), frame.settings.direct.reuse,
                          std::move(samples));
}

Samples reuse_direct_over_space(const FrameContext& frame, const ReuseInput& input, int iteration) {
    const ReusePlan& plan = frame.plan.direct.reuse;
    const ReuseShaders shaders{SpatialVariant::PATH, [&](ReuseRun run) -> const Program& {
                                   return frame.compute(SpatialVariant{plan.variant(run), plan.neighbours});
                               }};
    return reuse_over_space(frame, shaders, plan, frame.settings.direct.reuse, input, iteration);
}

}  // namespace tarn
