// What direct light can be told to do.
#pragma once

#include "settings/reuse_settings.h"

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

// What the picture shows instead of light: the visibility of the chosen samples, their light without it, or
// which samples they are, each in a colour of its own.
// Those from PATH_DIRECTION on show path samples; their order is that of PATH_VIEW_* in
// shaders/shared/interface/constants/shade.h.
enum class DebugView {
    NONE,
    VISIBILITY,
    UNSHADOWED,
    SAMPLES,
    PATH_DIRECTION,
    PATH_DISTANCE,
    PATH_NORMAL,
    PATH_RADIANCE,
    PATH_WEIGHT,
    PATH_AGE,
};

struct DirectSettings {
    DirectMode mode = DirectMode::RIS;
    LightSelection light_selection = LightSelection::POWER;
    int candidates = 32;
    bool brdf_candidate = false;
    int samples = 1;
    bool per_channel = false;
    DebugView debug_view = DebugView::NONE;
    ReuseSettings reuse;

    bool resamples() const { return mode == DirectMode::RIS || mode == DirectMode::RESTIR; }
    bool uses_restir() const { return mode == DirectMode::RESTIR; }
    bool reuses_time() const { return uses_restir() && reuse.reuses_time(); }
    bool reuses_space() const { return uses_restir() && reuse.reuses_space(); }
    bool reuses() const { return reuses_time() || reuses_space(); }

    // How candidates find their lights in this mode.
    LightSelection selection() const {
        if (mode == DirectMode::UNIFORM) return LightSelection::UNIFORM;
        if (mode == DirectMode::POWER) return LightSelection::POWER;
        if (mode == DirectMode::LIGHT_TREE) return LightSelection::TREE;
        return light_selection;
    }
    // Independent samples a pixel and frame; reuse keeps one.
    int sample_count() const { return reuses() ? 1 : samples; }

    bool operator==(const DirectSettings&) const = default;
};

}  // namespace tarn
