#include "plan/frame_plan.h"

#include "shared/math/colour.h"

namespace tarn {
namespace {

// `runs`: whether the stage reuses samples at all.
ReusePlan plan_reuse(const ReuseSettings& settings, bool runs, DebugView view) {
    ReusePlan plan;
    if (!runs || settings.reuse == Reuse::NONE) return plan;
    const bool visibility_is_known = settings.final_visibility != FinalVisibility::TRACED;
    plan.mis = settings.mis;
    plan.mis_visibility = settings.mis_visibility;
    plan.traces_in_mis = settings.traces_in_mis();
    plan.final_visibility = settings.final_visibility;
    plan.tests_fresh_samples = settings.visibility_reuse || plan.traces_in_mis || visibility_is_known;
    plan.drops_occluded = settings.visibility_reuse || plan.traces_in_mis;
    plan.over_time = settings.reuses_time();
    plan.filters_boiling = plan.over_time && settings.boiling_filter > 0.0;
    plan.spatial_steps = settings.reuses_space() ? settings.spatial_iterations : 0;
    plan.neighbours = settings.neighbours;
    plan.keeps_temporal = plan.over_time && (plan.spatial_steps == 0 || !settings.feedback);
    plan.tests_chosen_samples = !visibility_is_known && !plan.traces_in_mis;
    plan.shades_all_samples =
        settings.shade == SampleShading::ALL && settings.can_shade_all() && view == DebugView::NONE;
    return plan;
}

std::vector<glm::vec3> plan_targets(const DirectSettings& settings) {
    if (!settings.per_channel) return {glm::vec3(LUMINANCE_WEIGHTS)};
    return {glm::vec3(1.0f, 0.0f, 0.0f), glm::vec3(0.0f, 1.0f, 0.0f), glm::vec3(0.0f, 0.0f, 1.0f)};
}

std::vector<PlannedPass> list_passes(const DirectPlan& plan) {
    const ReusePlan& reuse = plan.reuse;
    return {
        {"lights/tree", plan.light_tree, "lights are drawn by the tree"},
        {"direct/light_tiles", plan.light_tiles, "candidates come from tiles"},
        {"direct/brdf_rays", plan.brdf_rays, "one candidate comes from a ray along the BRDF"},
        {"direct/initial_visibility", reuse.tests_fresh_samples,
         reuse.drops_occluded ? "occluded fresh samples are dropped" : "reuse asks whether samples are seen"},
        {"direct/temporal", reuse.over_time, "the last frame's samples are reused"},
        {"direct/boiling_filter", reuse.filters_boiling, "samples that outweigh their surroundings go"},
        {"direct/spatial", reuse.spatial_steps > 0, "neighbours' samples are reused"},
        {"visibility", reuse.tests_chosen_samples,
         reuse.runs() ? "the chosen samples are traced after all reuse" : "every sample is traced"},
    };
}

}  // namespace

DirectPlan plan_direct(const DirectSettings& settings) {
    DirectPlan plan;
    plan.brdf_rays = settings.resamples() && settings.brdf_candidate;
    plan.candidates = {settings.selection(), plan.brdf_rays};
    plan.light_tiles = plan.candidates.selection == LightSelection::TILES;
    plan.light_tree = plan.candidates.selection == LightSelection::TREE;
    plan.candidate_count = settings.resamples() ? settings.candidates : 1;
    plan.sample_count = settings.sample_count();
    plan.targets = plan_targets(settings);
    plan.reuse = plan_reuse(settings.reuse, settings.uses_restir(), settings.debug_view);
    plan.view = settings.debug_view;
    return plan;
}

FramePlan make_plan(const FeatureSurvey& survey, const RenderSettings& settings) {
    FramePlan plan;
    plan.features = survey.features;
    plan.feature_reasons = survey.reasons;
    plan.direct = plan_direct(settings.direct);
    const DebugView view = plan.direct.view;
    plan.composite.light_alone = view == DebugView::VISIBILITY || view == DebugView::SAMPLES;
    plan.passes = list_passes(plan.direct);
    return plan;
}

}  // namespace tarn
