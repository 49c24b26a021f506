// What indirect light can be told to do.
#pragma once

#include "settings/reuse_settings.h"

namespace tarn {

enum class IndirectMode {
    OFF,
    PATH,    // one path a pixel
    RESTIR,  // path samples reused over time and neighbours
};

// How the first direction of a path is drawn.
enum class IndirectSampling { UNIFORM, COSINE, BRDF };

// Where the random numbers of that direction come from.
enum class NoiseKind { WHITE, BLUE };

// Of the picture's pixels, along each axis.
enum class IndirectResolution { FULL, HALF, QUARTER };

// How light candidates at the surfaces of a path find their lamps: by power, or by a walk down the light
// tree.
enum class PathLights { POWER, TREE };

// Where the light beyond the last surface of a path comes from.
enum class IndirectCache {
    OFF,     // from nowhere
    SCREEN,  // what the last frame found, where that surface was in view
    WORLD,   // a hash grid in world space
};

// What samples are resampled in proportion to: the luminance of the radiance that arrives at a receiver, that
// of what it reflects, or each channel of what it reflects, with a sample for each.
enum class IndirectTarget { LUMINANCE, BRDF, CHANNEL };

struct IndirectSettings {
    IndirectMode mode = IndirectMode::OFF;
    IndirectSampling sampling = IndirectSampling::BRDF;
    NoiseKind noise = NoiseKind::WHITE;
    IndirectResolution resolution = IndirectResolution::FULL;
    int bounces = 1;     // surfaces that light meets before the one that is seen
    int candidates = 2;  // light candidates at each of them
    PathLights lights = PathLights::TREE;
    double light_rays = 0.25;  // of paths, those whose last surface sends a ray that looks for lamps
    IndirectCache cache = IndirectCache::OFF;
    int validation = 4;  // frames after which kept samples are asked again for their lamps; 0: never
    IndirectTarget target = IndirectTarget::BRDF;
    ReuseSettings reuse;

    bool runs() const { return mode != IndirectMode::OFF; }
    bool uses_restir() const { return mode == IndirectMode::RESTIR; }

    bool operator==(const IndirectSettings&) const = default;
};

}  // namespace tarn
