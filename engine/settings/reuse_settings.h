// What the reuse of samples over time and space can be told to do, whatever is reused.
#pragma once

namespace tarn {

// Whose samples a pixel reuses.
enum class Reuse { NONE, TEMPORAL, SPATIAL, SPATIOTEMPORAL };

// Weights of a reuse step; values are those of MIS_* in shared/math/mis.h.
enum class Mis { ONE_OVER_M, ONE_OVER_Z, BALANCE, PAIRWISE };

// How the visibility of the sample that lights a pixel is known; see lib/reuse/merge.glsl.
enum class FinalVisibility { TRACED, REUSED, AVERAGED };

// What lights a pixel: the sample that it chose, or all samples of the last step, each by its weight.
enum class SampleShading { CHOSEN, ALL };

struct ReuseSettings {
    Reuse reuse = Reuse::SPATIOTEMPORAL;
    int spatial_iterations = 1;
    int neighbours = 3;
    double radius_px = 30.0;
    bool feedback = true;
    Mis mis = Mis::PAIRWISE;
    bool mis_visibility = false;
    FinalVisibility final_visibility = FinalVisibility::TRACED;
    SampleShading shade = SampleShading::CHOSEN;
    bool visibility_reuse = true;  // Bitterli's: occluded fresh samples are dropped before anyone reuses them
    double confidence_cap = 20.0;
    double motion_cap = 4.0;
    int age_cap = 0;
    double boiling_filter = 0.0;
    bool permute = false;
    bool mirror = false;

    bool reuses_time() const { return reuse == Reuse::TEMPORAL || reuse == Reuse::SPATIOTEMPORAL; }
    bool reuses_space() const { return reuse == Reuse::SPATIAL || reuse == Reuse::SPATIOTEMPORAL; }
    // Whether the denominators of MIS trace rays, so that every kept sample is known to be seen.
    bool traces_in_mis() const { return mis_visibility && mis != Mis::ONE_OVER_M; }
    // Whether all samples of the last step may light the pixel: their weights sum to one and each is known to
    // be seen or not. No more rays than for the chosen one, and less noise, that of colour above all.
    bool can_shade_all() const {
        return reuses_space() && (mis == Mis::BALANCE || mis == Mis::PAIRWISE) &&
               (traces_in_mis() || final_visibility != FinalVisibility::TRACED);
    }

    bool operator==(const ReuseSettings&) const = default;
};

}  // namespace tarn
