// What direct light can be told to do; names, ranges and sentences: renderer/settings.cpp.
#pragma once

namespace tarn {

enum class DirectMode {
    UNIFORM,     // one random light, one ray
    POWER,       // one light by its power, one ray
    LIGHT_TREE,  // one light by a walk down the light tree, one ray
    RIS,         // streaming RIS over many candidates, one ray for the winner
    RESTIR,      // RIS, and samples reused over time and neighbours
};

// How a candidate finds its light.
enum class LightSelection { UNIFORM, POWER, TILES, TREE };

enum class Reuse { NONE, TEMPORAL, SPATIAL, SPATIOTEMPORAL };

// Weights of a reuse step; values are those of MIS_* in shared/math/mis.h, SHARE being MIS_CONSTANT.
enum class Mis { SHARE, COUNT, BALANCE, PAIRWISE };

// How the visibility of the sample that lights a pixel is known; see lib/reuse.glsl.
enum class SampleVisibility { TRACE, REUSE, AVERAGED };

// What lights a pixel: the sample that it chose, or all samples of the last step, each by its weight.
enum class SampleShading { CHOSEN, ALL };

// What the picture shows instead of light: the visibility of the chosen samples, their light without it, or
// which samples they are, each in a colour of its own.
enum class DebugView { NONE, VISIBILITY, UNSHADOWED, SAMPLES };

struct DirectSettings {
    DirectMode direct = DirectMode::RIS;
    LightSelection light_selection = LightSelection::POWER;
    int candidates = 32;
    bool brdf_candidate = false;
    int samples = 1;
    Reuse reuse = Reuse::SPATIOTEMPORAL;
    int spatial_iterations = 1;
    int neighbours = 3;
    double radius_px = 30.0;
    bool feedback = true;
    Mis mis = Mis::PAIRWISE;
    bool mis_visibility = false;
    SampleVisibility visibility = SampleVisibility::TRACE;
    SampleShading shade = SampleShading::CHOSEN;
    bool discard_occluded = true;
    bool per_channel = false;
    double confidence_cap = 20.0;
    double motion_cap = 4.0;
    int age_cap = 0;
    double boiling_filter = 0.0;
    bool permute = false;
    bool mirror = false;
    DebugView debug_view = DebugView::NONE;

    bool resamples() const { return direct == DirectMode::RIS || direct == DirectMode::RESTIR; }
    // How candidates find their lights in this mode.
    LightSelection selection() const {
        if (direct == DirectMode::UNIFORM) return LightSelection::UNIFORM;
        if (direct == DirectMode::POWER) return LightSelection::POWER;
        if (direct == DirectMode::LIGHT_TREE) return LightSelection::TREE;
        return light_selection;
    }

    bool uses_restir() const { return direct == DirectMode::RESTIR; }
    bool reuses_time() const {
        return uses_restir() && (reuse == Reuse::TEMPORAL || reuse == Reuse::SPATIOTEMPORAL);
    }
    bool reuses_space() const {
        return uses_restir() && (reuse == Reuse::SPATIAL || reuse == Reuse::SPATIOTEMPORAL);
    }
    bool reuses_both() const { return reuses_time() && reuses_space(); }
    bool reuses() const { return reuses_time() || reuses_space(); }

    bool takes_samples() const { return !reuses(); }
    // Independent samples a pixel and frame; reuse keeps one.
    int sample_count() const { return takes_samples() ? samples : 1; }

    // Whether the denominators of MIS trace rays, so that every kept sample is known to be seen.
    bool traces_in_mis() const { return reuses() && mis_visibility && mis != Mis::SHARE; }
    // Whether fresh samples are tested before anyone reuses them.
    bool tests_fresh_samples() const {
        return reuses() && (discard_occluded || traces_in_mis() || visibility != SampleVisibility::TRACE);
    }
    // Whether all samples of the last step may light the pixel: their weights sum to one and each is known to
    // be seen or not. No more rays than for the chosen one, and less noise, that of colour above all.
    bool can_shade_all() const {
        return reuses_space() && (mis == Mis::BALANCE || mis == Mis::PAIRWISE) &&
               (traces_in_mis() || visibility != SampleVisibility::TRACE);
    }
    bool shades_all() const {
        return shade == SampleShading::ALL && can_shade_all() && debug_view == DebugView::NONE;
    }
    // Whether the chosen sample of each pixel is tested after all reuse.
    bool traces_chosen_samples() const {
        return !reuses() || (visibility == SampleVisibility::TRACE && !traces_in_mis());
    }
};

}  // namespace tarn
