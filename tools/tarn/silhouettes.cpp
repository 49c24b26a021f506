#include "silhouettes.h"

#include <tbb/parallel_for.h>

#include "shared/math/random.h"

namespace tarn {
namespace {

// Surfaces of partial coverage show their edges in some frames only.
constexpr std::uint32_t FRAMES = 4;

}  // namespace

std::vector<std::uint32_t> find_silhouettes(Renderer& renderer, const RayTracer& tracer, FrameInput input) {
    const int width = renderer.width_px(), height = renderer.height_px();
    input.settings.antialias = {};  // the raster at the pixels' centres
    std::vector<char> differs(std::size_t(width) * std::size_t(height), 0);
    for (input.frame = 0; input.frame < FRAMES; ++input.frame) {
        const auto seen = renderer.render(input).gbuffer.seen->download<glm::uvec2>();
        tbb::parallel_for(std::size_t(0), seen.size(), [&](std::size_t pixel) {
            const glm::vec2 centre(float(pixel % std::size_t(width)) + 0.5f,
                                   float(pixel / std::size_t(width)) + 0.5f);
            const PixelRay view = camera_ray(input.camera, centre, glm::vec2(width, height));
            const RayRecord ray{view.origin, RAY_INFINITY, view.direction, std::uint32_t(pixel)};
            const auto hit =
                tracer.trace_closest(ray, {input.frame, input.seed, RAY_CAMERA}, BackFaces::PASS);
            const glm::uvec2 met =
                hit ? glm::uvec2(hit->instance, hit->primitive) : glm::uvec2(INVALID_INDEX);
            if (met != seen[pixel]) differs[pixel] = 1;
        });
    }
    std::vector<std::uint32_t> pixels;
    for (std::size_t pixel = 0; pixel < differs.size(); ++pixel) {
        if (differs[pixel] != 0) pixels.push_back(std::uint32_t(pixel));
    }
    return pixels;
}

}  // namespace tarn
