// Runs the reference on a scene written in code and compares its images.
#pragma once

#include "core/log.h"
#include "reference/reference.h"
#include "support/tile_test.h"
#include "support/toy_scenes.h"

namespace tarn {

// A small image of `world` as seen from `position_ws`, with everything else left at its default.
inline ReferenceSettings small_settings(const World& world, const glm::dvec3& position_ws,
                                        const glm::dvec3& target_ws, double vertical_fov_deg) {
    ReferenceSettings settings;
    settings.width = settings.height = 32;
    settings.camera = look_at(world, position_ws, target_ws, vertical_fov_deg, 1.0);
    return settings;
}

inline ReferenceResult run_reference(const World& world, const ReferenceSettings& settings) {
    set_quiet(true);
    return render_reference(world, *create_embree_tracer(world), settings);
}

// z-test of a rendered image against another, or against known values, in tiles of 8 pixels.
inline TileTest compare_images(const ReferenceResult& a, const ReferenceResult& b) {
    return test_tiles({a.radiance, a.variance}, {b.radiance, b.variance}, 8, 1e-3);
}

inline TileTest compare_with_known(const ReferenceResult& result, const Image& known,
                                   double rounding = 1e-5) {
    return test_tiles({result.radiance, result.variance}, {known, Image(known.width, known.height, 3)}, 8,
                      1e-3, rounding);
}

// The ray through the centre of a pixel, in double precision, relative to the world's origin.
struct PreciseRay {
    glm::dvec3 origin;
    glm::dvec3 direction;
};

inline PreciseRay pixel_ray(const ReferenceSettings& s, int x, int y) {
    const double px = 2.0 * (x + 0.5) / s.width - 1.0, py = 1.0 - 2.0 * (y + 0.5) / s.height;
    const CameraRecord& c = s.camera;
    return {glm::dvec3(c.position),
            glm::normalize(glm::dvec3(c.forward) + glm::dvec3(c.right) * px + glm::dvec3(c.up) * py)};
}

}  // namespace tarn
