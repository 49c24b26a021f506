#include "passes/indirect/reuse.h"

#include "shared/math/path_sample.h"

namespace tarn {

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
             PATH_SAMPLE_ROWS}};
}

}  // namespace tarn
