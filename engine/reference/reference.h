// The reference that everything else is measured against: a path tracer over the same world, rays and
// material functions, without resampling and without history.
#pragma once

#include <atomic>
#include <cstdint>

#include "core/image.h"
#include "rays/ray_tracer.h"
#include "shared/interface/records.h"
#include "world/world.h"

namespace tarn {

// How light reaches a surface: MIS weighs both ways with the power heuristic; the others use one alone, for
// tests. Punctual lights are always sampled directly.
enum class LightStrategy { MIS, LIGHTS_ONLY, BRDF_ONLY };

// Mistakes that tests plant to see that they are found.
enum class PlantedBug { NONE, DROP_COSINE, DROP_LIGHT_PDF, DOUBLE_COUNT_EMISSION };

struct ReferenceSettings {
    int width = 640;
    int height = 360;
    CameraRecord camera{};
    int bounces = 8;  // scattering events: 0 shows emission alone, 1 adds direct light; at most MAX_BOUNCES
    bool direct_only =
        false;  // emission seen by the camera and direct light at the first surface, as bounces = 1
    std::uint64_t spp = 64;       // samples a pixel; with `relative_error` > 0 the most that are taken
    double relative_error = 0.0;  // > 0: stop when the image's relative error (see ReferenceResult) is below
    std::uint32_t seed = 0;
    bool box_pixel_filter = false;  // false: the pixel's centre, as the rasterizer sees it
    LightStrategy strategy = LightStrategy::MIS;
    // Lights drawn by a light tree, built for the picture, instead of by power: where they are many, the same
    // error in fewer samples.
    bool light_tree = false;
    PlantedBug planted_bug = PlantedBug::NONE;
    const std::atomic<bool>* cancel = nullptr;  // when it turns true, the current pass is the last
};

// The random numbers of coverage tell this many bounce rays apart.
inline constexpr int MAX_BOUNCES = 60;
// And this many samples.
inline constexpr std::uint64_t MAX_SPP = std::uint64_t(1) << 26;

struct ReferenceResult {
    Image radiance;  // 3 channels, linear
    Image variance;  // of the mean, per pixel and channel
    std::uint64_t spp = 0;
    std::uint64_t rays = 0;
    std::uint64_t non_finite = 0;  // samples that were NaN or infinite: left out of the mean
    // Root over the pixels' mean of variance / (luminance^2 + (1 % of the image's mean luminance)^2).
    double relative_error = 0.0;
    double seconds = 0.0;
    bool cancelled = false;
};

// Renders on the worker threads, with progress. The same bits for any number of threads. Throws Error for a
// size, sample count or number of bounces out of range.
ReferenceResult render_reference(const World& world, const RayTracer& tracer,
                                 const ReferenceSettings& settings);

}  // namespace tarn
