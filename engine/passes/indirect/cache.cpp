#include "passes/indirect/cache.h"

#include <algorithm>
#include <cmath>

#include "core/statistics.h"
#include "passes/indirect/coarse.h"
#include "passes/trace_rays.h"
#include "shared/interface/bindings.h"
#include "shared/interface/constants/cache.h"
#include "shared/interface/radiance_cache.h"
#include "shared/interface/records.h"
#include "shared/math/colour.h"
#include "shared/math/random.h"

namespace tarn {
namespace {

// One path in so many by so many adds to the cache.
constexpr int STEP_PX = 2;
constexpr float LEAST_CELL_SHARE = 1.0f / 16.0f;
// A sum counts 64 times the typical irradiance as 1, and its low word 2^-32 of that.
constexpr double UNIT_IRRADIANCE = 64.0;
constexpr glm::ivec2 BUCKETS_PX(int(CACHE_BUCKETS_WIDE), int(CACHE_BUCKETS / CACHE_BUCKETS_WIDE));

struct CachePaths {
    CacheConstants constants{};
    glm::ivec2 size_px{0};
    std::size_t count = 0;
};

CachePaths plan_paths(const FrameContext& frame, const SampleSlot& slot, double typical_irradiance) {
    CachePaths paths;
    paths.size_px = coarse_size_px(frame.size_px, STEP_PX);
    paths.count = std::size_t(paths.size_px.x) * std::size_t(paths.size_px.y);
    const glm::uvec2 offset = pick_offset(frame.frame, STEP_PX);
    CacheConstants& c = paths.constants;
    c.target_weights = slot.target_weights;
    c.candidate_count = std::uint32_t(frame.plan.indirect.candidate_count);
    c.cache_width = std::uint32_t(paths.size_px.x);
    c.cache_height = std::uint32_t(paths.size_px.y);
    c.cache_step = std::uint32_t(STEP_PX);
    c.cache_offset_x = offset.x;
    c.cache_offset_y = offset.y;
    // In the dark all samples are 0, and any unit will do.
    c.cache_unit = float(UNIT_IRRADIANCE * (typical_irradiance > 0.0 ? typical_irradiance : 1.0));
    c.cache_cell_share = find_cell_share(frame);
    c.cache_limit = float(std::ldexp(1.0, 31) / double(paths.count));
    return paths;
}

Rows take_rows(const FrameContext& frame, const std::string& name, std::size_t rows, BufferUse use) {
    return frame.recorder.take_rows(name, rows * sizeof(glm::uvec4), use);
}

CacheCells take_cells(const FrameContext& frame) {
    return take_rows(frame, "indirect/cache_cells", std::size_t(CACHE_BUCKETS) * CACHE_BUCKET_ROWS,
                     BufferUse::DEVICE);
}

Rows take_empty_sums(const FrameContext& frame) {
    const Rows sums =
        take_rows(frame, "indirect/cache_sums", std::size_t(CACHE_BUCKETS) * CACHE_PLACES * CACHE_SUM_ROWS,
                  BufferUse::DEVICE);
    sums->buffer().clear();
    return sums;
}

Rows write_rays(const FrameContext& frame, const CachePaths& paths, const Rows& path_states,
                const CacheCells& cells, const Rows& sums) {
    const Rows rays = take_rows(frame, "indirect/cache_rays", paths.count * RAY_ROWS, BufferUse::SHARED);
    PassRecorder pass = frame.pass("indirect/cache_rays");
    pass.constants(paths.constants)
        .read(UNIT_PASS_A, path_states)
        .read_table(UNIT_PASS_B, *cells)
        .write(0, rays)
        .write(1, sums)
        .dispatch(frame.compute(CacheRaysVariant{}), paths.size_px);
    return rays;
}

struct LitHits {
    Rows samples;
    Rows shadow_rays;
};

LitHits light_hits(const FrameContext& frame, const CachePaths& paths, const Rows& hits,
                   const CacheSources& sources) {
    const LitHits lit{
        take_rows(frame, "indirect/cache_samples", paths.count * CACHE_SAMPLE_ROWS, BufferUse::DEVICE),
        take_rows(frame, "indirect/cache_shadow_rays", paths.count * RAY_ROWS, BufferUse::SHARED)};
    PassRecorder pass = frame.pass("indirect/cache_vertices");
    if (sources.light_tree != nullptr) pass.read_table(UNIT_PASS_E, *sources.light_tree);
    pass.constants(paths.constants)
        .read(UNIT_PASS_A, hits)
        .read_table(UNIT_PASS_B, *sources.cells)
        .write(0, lit.samples)
        .write(1, lit.shadow_rays)
        .count(BLOCK_COUNTERS, frame.counters)
        .dispatch(frame.compute(CacheVerticesVariant{frame.plan.indirect.lights}), paths.size_px);
    return lit;
}

void add_samples(const FrameContext& frame, const CachePaths& paths, const Rows& path_states,
                 const CacheCells& cells, const Rows& samples, const Answers& answers, const Rows& sums) {
    PassRecorder pass = frame.pass("indirect/cache_update");
    pass.constants(paths.constants)
        .read(UNIT_PASS_A, path_states)
        .read_table(UNIT_PASS_B, *cells)
        .read(UNIT_PASS_C, samples)
        .read(UNIT_PASS_D, answers)
        .read_write(0, sums)
        .count(BLOCK_COUNTERS, frame.counters)
        .dispatch(frame.compute(CacheUpdateVariant{}), paths.size_px);
}

CacheCells make_next_cells(const FrameContext& frame, const CachePaths& paths, const CacheCells& cells,
                           const Rows& sums) {
    const CacheCells next = take_cells(frame);
    PassRecorder pass = frame.pass("indirect/cache_resolve");
    pass.constants(paths.constants)
        .read_table(UNIT_PASS_A, *cells)
        .read(UNIT_PASS_B, sums)
        .write(0, next)
        .count(BLOCK_COUNTERS, frame.counters)
        .dispatch(frame.compute(CacheResolveVariant{}), BUCKETS_PX);
    return next;
}

}  // namespace

PathCache find_path_cache(const FrameContext& frame, const GBuffer& gbuffer,
                          const std::optional<Previous<Picture>>& light,
                          const std::optional<Previous<CacheCells>>& cells) {
    PathCache cache;
    if (frame.plan.indirect.cache == IndirectCache::WORLD) {
        cache.kind = IndirectCache::WORLD;
        cache.cells = cells ? cells->value() : take_cells(frame);
        if (!cells) cache.cells->buffer().clear();
    }
    if (frame.plan.indirect.cache != IndirectCache::SCREEN || !light || !gbuffer.previous) return cache;
    // The picture may have been kept at another resolution of indirect light.
    const Texture2D& kept = *light->value();
    if (glm::ivec2(kept.width_px(), kept.height_px()) != frame.size_px) return cache;
    cache.kind = IndirectCache::SCREEN;
    cache.light = light;
    cache.surfaces = gbuffer.previous;
    return cache;
}

float find_cell_share(const FrameContext& frame) {
    const glm::ivec2 paths = coarse_size_px(frame.size_px, STEP_PX);
    return std::max(LEAST_CELL_SHARE, 4.0f / std::sqrt(float(paths.x * paths.y)));
}

void read_path_cache(PassRecorder& pass, const PathCache& cache) {
    if (cache.kind == IndirectCache::WORLD) pass.read_table(UNIT_PASS_D, *cache.cells);
    if (cache.kind != IndirectCache::SCREEN) return;
    pass.read(UNIT_PASS_D, *cache.light, cache.light->value())
        .read(UNIT_PREVIOUS_SURFACE, *cache.surfaces, cache.surfaces->value()->texels());
}

double estimate_irradiance(const World& world) {
    constexpr std::size_t SKY_TEXELS = 4096;  // are enough for an estimate
    const std::vector<glm::vec4>& sky = world.environment.texels;
    RunningMoments radiance;
    for (std::size_t i = 0; i < sky.size(); i += 1 + sky.size() / SKY_TEXELS) {
        radiance.add(double(luminance(glm::vec3(sky[i]))));
    }
    double irradiance = sky.empty() ? 0.0 : radiance.mean() * double(PI);
    double power = 0.0;
    for (const double lamp : world.lights.powers) power += lamp;
    const double diameter = world.bounds.empty() ? 0.0 : glm::length(glm::dvec3(world.bounds.extent()));
    if (diameter > 0.0) irradiance += power / (diameter * diameter);
    return irradiance;
}

CacheCells update_cells(const FrameContext& frame, const SampleSlot& slot, const Rows& path_states,
                        const CacheSources& sources) {
    const CacheCells& cells = sources.cells;
    const CachePaths paths = plan_paths(frame, slot, sources.typical_irradiance);
    const Rows sums = take_empty_sums(frame);
    const Rows rays = write_rays(frame, paths, path_states, cells, sums);
    CoverageKey key = slot.shadow_key;
    key.ray = RAY_BOUNCE + std::uint32_t(frame.plan.indirect.bounces);
    const Rows hits = trace_closest_hits(frame, "indirect/cache_hits", rays, paths.count, key);
    const LitHits lit = light_hits(frame, paths, hits, sources);
    const Answers answers =
        trace_visibility(frame, "indirect/cache_shadows", lit.shadow_rays, paths.count, slot.shadow_key);
    add_samples(frame, paths, path_states, cells, lit.samples, answers, sums);
    return make_next_cells(frame, paths, cells, sums);
}

}  // namespace tarn
