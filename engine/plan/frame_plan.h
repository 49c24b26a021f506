// What a frame runs, and why: made from the world and the settings before the first pass, followed by all of
// them.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "plan/scene_features.h"
#include "plan/shader_variants.h"
#include "settings/settings.h"

namespace tarn {

// Which steps of reuse run, and in which variants; whatever is reused.
struct ReusePlan {
    Mis mis = Mis::PAIRWISE;
    bool mis_visibility = false;
    bool traces_in_mis = false;  // rays in the denominators of MIS: every kept sample is known to be seen
    FinalVisibility final_visibility = FinalVisibility::TRACED;
    bool tests_fresh_samples = false;  // before anyone reuses them
    bool drops_occluded = false;       // and drops those that are not seen
    bool over_time = false;
    bool filters_boiling = false;
    int spatial_steps = 0;
    int neighbours = 0;
    bool keeps_temporal =
        false;  // the next frame starts from the samples after reuse over time, not over space
    bool tests_chosen_samples = true;  // after all reuse, by a ray
    int step_px = 1;                   // of the picture, from one pixel with samples to the next
    bool shades_all_samples = false;   // the last spatial step sums the light of all its samples

    bool runs() const { return over_time || spatial_steps > 0; }
    // Rays in the weights leave no question open: then the final visibility changes nothing.
    ReuseVariant variant(ReuseRun run) const {
        const FinalVisibility open = traces_in_mis ? FinalVisibility::TRACED : final_visibility;
        return {mis, traces_in_mis, open, run};
    }
};

struct DirectPlan {
    CandidatesVariant candidates;
    bool light_tiles = false;
    bool light_tree = false;
    bool brdf_rays = false;
    int candidate_count = 1;
    int sample_count = 1;            // independent samples a pixel
    std::vector<glm::vec4> targets;  // SampleSlot::target_weights: luminance, or each channel
    ReusePlan reuse;
    DebugView view = DebugView::NONE;

    // Whether the sum that the last spatial step makes is all the light there is.
    bool is_lit_by_reuse() const {
        return reuse.shades_all_samples && sample_count == 1 && targets.size() == 1;
    }
};

struct IndirectPlan {
    bool runs = false;
    bool keeps_samples = false;  // as reservoirs, for reuse; else paths light their pixels at once
    int step_px = 1;             // > 1: it works on a coarse picture of one pixel in step x step
    int bounces = 1;
    int candidate_count = 1;
    PathLights lights = PathLights::POWER;
    float light_rays = 0.0f;
    IndirectSampling sampling = IndirectSampling::BRDF;
    NoiseKind noise = NoiseKind::WHITE;
    IndirectCache cache = IndirectCache::OFF;
    std::vector<glm::vec4> targets;  // as above; a sample for each
    ReusePlan reuse;
    DebugView view = DebugView::NONE;  // of the chosen path samples

    // As for direct light.
    bool is_lit_by_reuse() const { return reuse.shades_all_samples && targets.size() == 1; }
};

struct DenoisePlan {
    DenoiseMode mode = DenoiseMode::OFF;
    bool runs = false;
    bool keeps_filtered =
        false;            // the history is what the filter's first step makes; else the mean over time
    bool adapts = false;  // the history is cut short where light changes
    LightSamplesVariant light_samples;
    int steps = 1;
    DenoiseKernel kernel = DenoiseKernel::BOX3;
    DenoiseAccumulateVariant accumulate;

    DenoiseFilterVariant filter(bool is_first, bool is_last) const {
        return {kernel, keeps_filtered, is_first && keeps_filtered, is_last};
    }
};

struct AntialiasPlan {
    bool runs = false;
    bool enlarges = false;
    int jitter_count = 1;  // frames after which the places in a pixel come again
};

// Where a frame is drawn.
struct DrawingPlace {
    std::uint64_t pixels = 1;
    bool slow_triangles = false;  // DriverQuirks
};

// How pixels find what they see.
struct PrimaryPlan {
    bool by_rays = false;
    std::string reason;
};

// A pass that this frame runs or leaves out.
struct PlannedPass {
    std::string name;  // as in the timings
    bool runs = true;
    std::string reason;  // "--brdf-candidate on"
};

struct FramePlan {
    SceneFeatures features;
    std::vector<FeatureReason> feature_reasons;
    PrimaryPlan primary;
    DirectPlan direct;
    IndirectPlan indirect;
    DenoisePlan denoise;
    AntialiasPlan antialias;
    CompositeVariant composite;
    std::vector<PlannedPass> passes;  // those that not every frame runs

    bool has_light_tree() const {
        return direct.light_tree || (indirect.runs && indirect.lights == PathLights::TREE);
    }
};

PrimaryPlan plan_primary(const PrimarySettings& settings, const FeatureSurvey& survey,
                         const DrawingPlace& place);
DirectPlan plan_direct(const DirectSettings& settings);
IndirectPlan plan_indirect(const IndirectSettings& settings);
// Debug views are shown as they are.
DenoisePlan plan_denoise(const RenderSettings& settings, const DirectPlan& direct,
                         const SceneFeatures& features);

// Debug views too.
AntialiasPlan plan_antialias(const RenderSettings& settings);

FramePlan make_plan(const FeatureSurvey& survey, const RenderSettings& settings,
                    const DrawingPlace& place = {});

}  // namespace tarn
