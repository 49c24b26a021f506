#include "passes/reuse/samples.h"

namespace tarn {

SampleMeaning meaning_of(const ReusePlan& plan, const glm::vec4& target_weights) {
    return {target_weights,       plan.mis,    plan.traces_in_mis, plan.final_visibility, plan.drops_occluded,
            plan.filters_boiling, plan.step_px};
}

std::optional<Previous<KeptSamples>> find_previous(const FrameContext& frame, const ReusePlan& plan,
                                                   const History<KeptSamples>& history,
                                                   const glm::vec4& target_weights) {
    if (!plan.over_time || !frame.previous) return std::nullopt;
    auto previous = history.of_frame(frame.previous->key.frame);
    if (!previous || previous->value().meaning != meaning_of(plan, target_weights)) return std::nullopt;
    if (plan.traces_in_mis && !frame.tracer.remembers(frame.previous->geometry_revision)) return std::nullopt;
    return previous;
}

}  // namespace tarn
