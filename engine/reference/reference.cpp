#include "reference/reference.h"

#include <tbb/blocked_range2d.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <chrono>
#include <limits>

#include "core/error.h"
#include "core/log.h"
#include "rays/flush_denormals.h"
#include "reference/film.h"
#include "reference/path_integrator.h"

namespace tarn {
namespace {

constexpr int TILE_PX = 16;
// Samples of a pass: enough that passes cost nothing, few enough that cancelling is quick.
constexpr std::uint64_t PASS_SAMPLES = 8;
// The error estimate of fewer samples is not to be trusted.
constexpr std::uint64_t MIN_SAMPLES_FOR_ERROR = 32;

void check_settings(const ReferenceSettings& s) {
    const std::uint64_t pixels = std::uint64_t(std::max(0, s.width)) * std::uint64_t(std::max(0, s.height));
    if (s.width < 1 || s.height < 1 || pixels > std::numeric_limits<std::uint32_t>::max()) {
        throw Error("reference: the size is {}x{}, it must be at least 1x1 and hold less than 2^32 pixels",
                    s.width, s.height);
    }
    if (s.spp < 1 || s.spp > MAX_SPP)
        throw Error("reference: spp is {}, the range is 1 to {}", s.spp, MAX_SPP);
    if (s.bounces < 0 || s.bounces > MAX_BOUNCES) {
        throw Error("reference: bounces is {}, the range is 0 to {}", s.bounces, MAX_BOUNCES);
    }
}

// Adds samples [first, first + count) to every pixel. Each pixel belongs to one task, which adds in order.
std::uint64_t render_pass(const World& world, const LightTree& light_tree, const RayTracer& tracer,
                          const ReferenceSettings& settings, Film& film, std::uint64_t first,
                          std::uint64_t count) {
    std::atomic<std::uint64_t> rays{0};
    const auto render_tile = [&](const tbb::blocked_range2d<int>& tile) {
        const FlushDenormals flush;
        PathIntegrator integrator(world, light_tree, tracer, settings);
        for (int row = tile.rows().begin(); row != tile.rows().end(); ++row) {
            for (int column = tile.cols().begin(); column != tile.cols().end(); ++column) {
                const std::size_t pixel =
                    std::size_t(row) * std::size_t(settings.width) + std::size_t(column);
                for (std::uint64_t sample = first; sample < first + count; ++sample) {
                    film.add(pixel, integrator.sample_radiance(column, row, std::uint32_t(sample)));
                }
            }
        }
        rays += integrator.rays();
    };
    tbb::parallel_for(tbb::blocked_range2d<int>(0, settings.height, TILE_PX, 0, settings.width, TILE_PX),
                      render_tile);
    return rays;
}

// Share of the work that is done, in thousandths, for the progress bar. The error falls with the root of the
// samples.
std::uint64_t estimate_progress(const ReferenceSettings& settings, std::uint64_t spp, double error) {
    double share = double(spp) / double(settings.spp);
    if (settings.relative_error > 0.0 && error > 0.0) {
        share = std::max(share,
                         std::min(1.0, settings.relative_error * settings.relative_error / (error * error)));
    }
    return std::uint64_t(1000.0 * share);
}

}  // namespace

ReferenceResult render_reference(const World& world, const RayTracer& tracer,
                                 const ReferenceSettings& settings) {
    check_settings(settings);
    const auto start = std::chrono::steady_clock::now();
    LightTree light_tree;
    if (settings.light_tree) update_light_tree(light_tree, world.lights);
    Film film(settings.width, settings.height);
    Progress progress("reference", 1000);
    ReferenceResult result;
    while (result.spp < settings.spp && !result.cancelled) {
        const std::uint64_t count = std::min(PASS_SAMPLES, settings.spp - result.spp);
        result.rays += render_pass(world, light_tree, tracer, settings, film, result.spp, count);
        result.spp += count;
        result.cancelled = settings.cancel != nullptr && settings.cancel->load();
        result.relative_error = film.relative_error();
        progress.update(estimate_progress(settings, result.spp, result.relative_error));
        if (result.spp >= MIN_SAMPLES_FOR_ERROR && result.relative_error < settings.relative_error) break;
    }
    result.radiance = film.mean();
    result.variance = film.variance_of_mean();
    result.non_finite = film.non_finite();
    result.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    return result;
}

}  // namespace tarn
