#include "passes/direct/reuse.h"

namespace tarn {

Samples apply_direct_visibility(const FrameContext& frame, Samples fresh, const Answers& answers) {
    using Variant = InitialVisibilityVariant;
    const ReuseShaders shaders{Variant::PATH,
                               [&](ReuseRun) -> const Program& { return frame.compute(Variant{}); }};
    return apply_initial_visibility(frame, shaders, frame.plan.direct.reuse, std::move(fresh), answers);
}

ReuseStage direct_reuse(const FrameContext& frame) {
    const ReusePlan& plan = frame.plan.direct.reuse;
    return {
        "direct",
        plan,
        frame.settings.direct.reuse,
        {TemporalVariant::PATH,
         [&](ReuseRun run) -> const Program& { return frame.compute(TemporalVariant{plan.variant(run)}); }},
        {BoilingFilterVariant::PATH,
         [&](ReuseRun) -> const Program& { return frame.compute(BoilingFilterVariant{}); }},
        {SpatialVariant::PATH, [&](ReuseRun run) -> const Program& {
             return frame.compute(SpatialVariant{plan.variant(run), plan.neighbours});
         }}};
}

}  // namespace tarn
