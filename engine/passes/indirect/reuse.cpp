#include "passes/indirect/reuse.h"

#include "shared/math/path_sample.h"

namespace tarn {

bool tests_lamps(const FrameContext& frame) {
    const ReusePlan& plan = frame.plan.indirect.reuse;
    if (!plan.over_time || !frame.previous) return false;
    if (!frame.tracer.remembers(frame.previous->geometry_revision)) return false;
    if (plan.traces_in_mis) return frame.scene_changed;
    const auto interval = std::uint32_t(frame.settings.indirect.validation);
    return interval > 0 && frame.frame % interval == 0 && frame.paths_may_be_stale;
}

ReuseStage indirect_reuse(const FrameContext& frame) {
    const ReusePlan& plan = frame.plan.indirect.reuse;
    return {"indirect",
            plan,
            frame.settings.indirect.reuse,
            {IndirectTemporalVariant::PATH,
             [&](ReuseRun run) -> const Program& {
                 return frame.compute(IndirectTemporalVariant{{plan.variant(run)}});
             },
             PATH_SAMPLE_ROWS},
            {IndirectBoilingFilterVariant::PATH,
             [&](ReuseRun) -> const Program& { return frame.compute(IndirectBoilingFilterVariant{}); },
             PATH_SAMPLE_ROWS},
            {IndirectSpatialVariant::PATH,
             [&](ReuseRun run) -> const Program& {
                 return frame.compute(IndirectSpatialVariant{{plan.variant(run), plan.neighbours}});
             },
             PATH_SAMPLE_ROWS},
            tests_lamps(frame)};
}

}  // namespace tarn
