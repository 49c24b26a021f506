#include "plan/frame_plan.h"

#include <fmt/format.h>

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

// The fourth number: 1 for the target of light that arrives, 0 for that of what a surface reflects.
std::vector<glm::vec4> plan_targets(bool per_channel, float of_arriving = 0.0f) {
    if (!per_channel) return {glm::vec4(glm::vec3(LUMINANCE_WEIGHTS), of_arriving)};
    return {
        {1.0f, 0.0f, 0.0f, of_arriving}, {0.0f, 1.0f, 0.0f, of_arriving}, {0.0f, 0.0f, 1.0f, of_arriving}};
}

bool shows_paths(DebugView view) {
    return view >= DebugView::PATH_DIRECTION;
}

std::vector<PlannedPass> list_passes(const PrimaryPlan& plan) {
    return {{"gbuffer/raster", !plan.by_rays, plan.reason}, {"gbuffer/rays", plan.by_rays, plan.reason}};
}

std::vector<PlannedPass> list_passes(const DirectPlan& plan) {
    const ReusePlan& reuse = plan.reuse;
    return {
        {"direct/light_tiles", plan.light_tiles, "candidates come from tiles"},
        {"direct/brdf_rays", plan.brdf_rays, "one candidate comes from a ray along the BRDF"},
        {"direct/initial_visibility", reuse.tests_fresh_samples,
         reuse.drops_occluded ? "occluded fresh samples are dropped" : "reuse asks whether samples are seen"},
        {"direct/temporal", reuse.over_time, "the last frame's samples are reused"},
        {"direct/boiling_filter", reuse.filters_boiling, "samples that outweigh their surroundings go"},
        {"direct/spatial", reuse.spatial_steps > 0, "neighbours' samples are reused"},
        {"visibility", reuse.tests_chosen_samples,
         reuse.runs() ? "the chosen samples are traced after all reuse" : "every sample is traced"},
        {"direct/shade", !plan.is_lit_by_reuse(), "samples light their pixels"},
    };
}

std::vector<PlannedPass> list_passes(const IndirectPlan& plan) {
    const ReusePlan& reuse = plan.reuse;
    const bool samples = plan.keeps_samples;
    const bool is_coarse = plan.runs && plan.step_px > 1;
    const bool fills_cache = plan.runs && plan.cache == IndirectCache::WORLD;
    return {
        {"indirect/surfaces", is_coarse, "some pixels stand for those around them"},
        {"indirect/rays", plan.runs, "a path goes on from each pixel"},
        {"indirect/hits", plan.runs, "and meets surfaces"},
        {"indirect/vertices", plan.runs, "which are lit by light samples"},
        {"indirect/shadows", plan.runs, "if these are seen"},
        {"indirect/light_hits", plan.runs && plan.light_rays > 0.0f, "rays look for lamps near their ends"},
        {"indirect/cache_rays", fills_cache, "some paths go on, for the cache"},
        {"indirect/cache_hits", fills_cache, "and meet one surface more"},
        {"indirect/cache_vertices", fills_cache, "which is lit by light samples and by the cache"},
        {"indirect/cache_shadows", fills_cache, "if these are seen"},
        {"indirect/cache_update", fills_cache, "what they find is added to their cells"},
        {"indirect/cache_resolve", fills_cache, "cells age, come and go"},
        {"indirect/samples", plan.runs,
         samples ? "paths become samples for reuse" : "paths light their pixels"},
        {"indirect/temporal", samples && reuse.over_time, "the last frame's path samples are reused"},
        {"indirect/boiling_filter", samples && reuse.filters_boiling,
         "path samples that outweigh their surroundings go"},
        {"indirect/spatial", samples && reuse.spatial_steps > 0, "neighbours' path samples are reused"},
        {"indirect/visibility", samples && reuse.tests_chosen_samples,
         "the chosen path samples are traced after all reuse"},
        {"indirect/shade", samples && !plan.is_lit_by_reuse(), "the chosen path samples light their pixels"},
        {"indirect/upsample", is_coarse, "and their light reaches the pixels around them"},
    };
}

std::vector<PlannedPass> list_passes(const DenoisePlan& plan) {
    return {
        {"denoise/light_changes", plan.adapts, "light may change: samples of both frames are compared"},
        {"denoise/accumulate", plan.runs, "light joins that of the last frames"},
        {"denoise/filter", plan.runs, "and that of pixels that show the same surface"},
    };
}

std::vector<PlannedPass> list_passes(const AntialiasPlan& plan) {
    return {{"antialias", plan.runs, "each frame joins the picture of the last ones"},
            {"enlarge", plan.enlarges && !plan.runs, "less is rendered than is shown"}};
}

}  // namespace

// On two cores a triangle costs the rasterizer 0.12 to 0.18 us whatever its size, and a ray 0.03 to 0.04 us;
// 0.09 where it meets surfaces with an alpha test. Bounds lie between scenes in which the one and the other
// was faster (docs/findings.md).
PrimaryPlan plan_primary(const PrimarySettings& settings, const FeatureSurvey& survey,
                         const DrawingPlace& place) {
    constexpr double TRIANGLES_A_PIXEL = 0.12, TRIANGLES_A_PIXEL_WITH_ALPHA = 0.4;
    if (settings.visibility != PrimaryVisibility::AUTO)
        return {settings.visibility == PrimaryVisibility::RAYS, "as --primary says"};
    if (!place.slow_triangles) return {false, "the device is made for it"};
    const double ratio = double(survey.triangles) / double(place.pixels);
    const double bound = survey.partly_covered ? TRIANGLES_A_PIXEL_WITH_ALPHA : TRIANGLES_A_PIXEL;
    return {ratio > bound, fmt::format("{:.2g} triangles a pixel, and the CPU draws", ratio)};
}

DirectPlan plan_direct(const DirectSettings& settings) {
    DirectPlan plan;
    plan.brdf_rays = settings.resamples() && settings.brdf_candidate;
    plan.candidates = {settings.selection(), plan.brdf_rays};
    plan.light_tiles = plan.candidates.selection == LightSelection::TILES;
    plan.light_tree = plan.candidates.selection == LightSelection::TREE;
    plan.candidate_count = settings.resamples() ? settings.candidates : 1;
    plan.sample_count = settings.sample_count();
    plan.targets = plan_targets(settings.per_channel);
    plan.reuse = plan_reuse(settings.reuse, settings.uses_restir(), settings.debug_view);
    plan.view = settings.debug_view;
    return plan;
}

// A fresh path sample is where a ray has ended: its pixel sees it.
IndirectPlan plan_indirect(const IndirectSettings& settings) {
    IndirectPlan plan;
    plan.runs = settings.runs();
    plan.step_px = 1 << int(settings.resolution);
    plan.bounces = settings.bounces;
    plan.candidate_count = settings.candidates;
    plan.lights = settings.lights;
    plan.light_rays = float(settings.light_rays);
    plan.sampling = settings.sampling;
    plan.noise = settings.noise;
    plan.cache = settings.cache;
    plan.reuse = plan_reuse(settings.reuse, settings.uses_restir(), DebugView::NONE);
    plan.reuse.step_px = plan.step_px;
    plan.reuse.tests_fresh_samples = false;
    plan.reuse.drops_occluded = false;
    plan.keeps_samples = settings.uses_restir() && plan.reuse.runs();
    plan.targets = plan_targets(plan.keeps_samples && settings.target == IndirectTarget::CHANNEL,
                                settings.target == IndirectTarget::LUMINANCE ? 1.0f : 0.0f);
    return plan;
}

DenoisePlan plan_denoise(const RenderSettings& settings, const DirectPlan& direct,
                         const SceneFeatures& features) {
    DenoisePlan plan;
    plan.runs = settings.denoise.runs() && settings.direct.debug_view == DebugView::NONE;
    plan.mode = plan.runs ? settings.denoise.mode : DenoiseMode::OFF;
    plan.keeps_filtered = settings.denoise.knows_variance();
    plan.adapts = plan.mode == DenoiseMode::SVGF && (features.motion || features.light_history);
    // Samples that nobody has tested may be in shadow: what their lamps do would change nothing.
    plan.light_samples.asks_rays = features.motion || !direct.reuse.tests_fresh_samples;
    plan.steps = settings.denoise.steps;
    plan.kernel = settings.denoise.kernel;
    plan.accumulate = {settings.indirect.runs(), plan.adapts};
    return plan;
}

// Places in a pixel of the picture, 64 of them, and as many times more as it has pixels for one that is
// rendered: a power of two, so that they are even (find_jitter).
AntialiasPlan plan_antialias(const RenderSettings& settings) {
    constexpr int PLACES = 64;
    const double scale = settings.antialias.scale;
    AntialiasPlan plan;
    plan.enlarges = scale < 1.0;
    if (!settings.antialias.moves_samples() || settings.direct.debug_view != DebugView::NONE) return plan;
    plan.runs = settings.antialias.joins_frames();
    plan.jitter_count = PLACES;
    while (plan.jitter_count * scale * scale < PLACES) plan.jitter_count *= 2;
    return plan;
}

FramePlan make_plan(const FeatureSurvey& survey, const RenderSettings& settings, const DrawingPlace& place) {
    FramePlan plan;
    plan.features = survey.features;
    plan.feature_reasons = survey.reasons;
    plan.primary = plan_primary(settings.primary, survey, place);
    plan.direct = plan_direct(settings.direct);
    plan.indirect = plan_indirect(settings.indirect);
    plan.denoise = plan_denoise(settings, plan.direct, plan.features);
    plan.antialias = plan_antialias(settings);
    plan.composite.indirect = plan.indirect.runs && !plan.denoise.runs;
    const DebugView view = plan.direct.view;
    if (plan.indirect.keeps_samples && shows_paths(view)) {
        plan.indirect.view = view;
        plan.indirect.targets.resize(1);
        plan.indirect.reuse.shades_all_samples = false;
        plan.composite.indirect_alone = true;
    }
    plan.composite.light_alone =
        view == DebugView::VISIBILITY || view == DebugView::SAMPLES || plan.composite.indirect_alone;
    plan.passes = {{"lights/tree", plan.has_light_tree(), "lights are drawn by the tree"}};
    for (PlannedPass& pass : list_passes(plan.primary)) plan.passes.push_back(std::move(pass));
    for (PlannedPass& pass : list_passes(plan.direct)) plan.passes.push_back(std::move(pass));
    for (PlannedPass& pass : list_passes(plan.indirect)) plan.passes.push_back(std::move(pass));
    for (PlannedPass& pass : list_passes(plan.denoise)) plan.passes.push_back(std::move(pass));
    for (PlannedPass& pass : list_passes(plan.antialias)) plan.passes.push_back(std::move(pass));
    return plan;
}

}  // namespace tarn
