#include "passes/reuse/reuse.h"

#include "passes/reuse/boiling_filter.h"
#include "passes/reuse/spatial.h"
#include "passes/reuse/temporal.h"

namespace tarn {
namespace {

Samples reuse_kept(const FrameContext& frame, const ReuseStage& stage, const ReuseInput& fresh,
                   const History<KeptSamples>& kept) {
    Samples samples = fresh.samples;
    if (const auto previous = find_previous(frame, stage.plan, kept, fresh.slot.target_weights)) {
        samples = reuse_over_time(frame, stage.temporal, stage.plan, stage.settings, fresh, *previous);
    }
    if (!stage.plan.filters_boiling) return samples;
    return filter_boiling(frame, stage.boiling_filter, stage.settings, std::move(samples));
}

ReusedSamples reuse_neighbours(const FrameContext& frame, const ReuseStage& stage, const GBuffer& gbuffer,
                               const SampleSlot& slot, const Samples& samples) {
    ReusedSamples reused{samples, {}};
    for (int i = 0; i < stage.plan.spatial_steps; ++i) {
        const bool is_last = i + 1 == stage.plan.spatial_steps;
        ReuseInput input{gbuffer, slot, reused.samples, is_last && stage.plan.tests_chosen_samples};
        if (is_last && stage.plan.shades_all_samples) {
            reused.light = take_reflected_light(frame, stage.name + "/summed");
            input.light = &reused.light;
        }
        reused.samples = reuse_over_space(frame, stage.spatial, stage.plan, stage.settings, input, i);
    }
    return reused;
}

}  // namespace

ReusedSamples reuse_samples(const FrameContext& frame, const ReuseStage& stage, const GBuffer& gbuffer,
                            const SampleSlot& slot, const Samples& fresh, History<KeptSamples>& kept) {
    const ReusePlan& plan = stage.plan;
    const bool tests = plan.tests_chosen_samples && plan.spatial_steps == 0;
    const ReuseInput input{gbuffer, slot, fresh, tests, nullptr, stage.tests_carried_light};
    const Samples over_time = reuse_kept(frame, stage, input, kept);
    const ReusedSamples reused = reuse_neighbours(frame, stage, gbuffer, slot, over_time);
    if (plan.runs()) {
        const Samples& next = plan.keeps_temporal ? over_time : reused.samples;
        kept.keep(frame.frame, {next.reservoirs, meaning_of(plan, slot.target_weights)});
    }
    return reused;
}

}  // namespace tarn
