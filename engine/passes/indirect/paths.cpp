#include "passes/indirect/paths.h"

#include "passes/trace_rays.h"
#include "shared/interface/bindings.h"
#include "shared/interface/constants/indirect.h"
#include "shared/interface/path_state.h"
#include "shared/interface/records.h"
#include "shared/math/path_sample.h"
#include "shared/math/random.h"
#include "shared/math/reservoir.h"

namespace tarn {
namespace {

IndirectConstants constants_for(const FrameContext& frame, const SampleSlot& slot, int bounce) {
    IndirectConstants constants{};
    constants.target_weights = slot.target_weights;
    constants.bounce = std::uint32_t(bounce);
    constants.candidate_count = std::uint32_t(frame.plan.indirect.candidate_count);
    constants.cache_cell_share = find_cell_share(frame);
    const bool is_last = bounce + 1 == frame.plan.indirect.bounces;
    constants.ray_share = is_last ? frame.plan.indirect.light_rays : 1.0f;
    return constants;
}

Rows write_first_rays(const FrameContext& frame, const GBuffer& gbuffer, const SampleSlot& slot,
                      const RowBuffer* blue_noise) {
    const Rows rays = frame.take_pixel_rows("indirect/rays", RAY_ROWS, BufferUse::SHARED);
    const IndirectRaysVariant variant{frame.plan.indirect.sampling, frame.plan.indirect.noise};
    PassRecorder pass = frame.pass("indirect/rays");
    read_gbuffer(pass, gbuffer).constants(constants_for(frame, slot, 0)).write(0, rays);
    if (blue_noise != nullptr) pass.read_table(UNIT_PASS_A, *blue_noise);
    pass.dispatch(frame.compute(variant), frame.size_px);
    return rays;
}

// What a vertex leaves behind besides the path's state.
struct VertexRays {
    Rows shadow;
    Rows next;  // along which the path goes on, or looks for lamps; null: neither
};

VertexRays light_vertices(const FrameContext& frame, const SampleSlot& slot, int bounce, const Rows& hits,
                          const PathSources& sources, Paths& paths) {
    const bool is_last = bounce + 1 == frame.plan.indirect.bounces;
    VertexRays rays;
    rays.shadow = frame.take_pixel_rows("indirect/shadow_rays", RAY_ROWS, BufferUse::SHARED);
    const IndirectConstants constants = constants_for(frame, slot, bounce);
    if (constants.ray_share > 0.0f)
        rays.next = frame.take_pixel_rows("indirect/rays", RAY_ROWS, BufferUse::SHARED);
    const Rows states = frame.take_pixel_rows("indirect/path_states", PATH_STATE_ROWS, BufferUse::DEVICE);
    PassRecorder pass = frame.pass("indirect/vertices");
    pass.constants(constants)
        .read(UNIT_PASS_A, hits)
        .write(0, states)
        .write(1, rays.shadow)
        .count(BLOCK_COUNTERS, frame.counters);
    if (bounce > 0) pass.read(UNIT_PASS_B, paths.answers).read(UNIT_PASS_C, paths.states);
    if (rays.next) pass.write(2, rays.next);
    if (sources.light_tree != nullptr) pass.read_table(UNIT_PASS_E, *sources.light_tree);
    if (is_last) read_path_cache(pass, sources.cache);
    const PathVerticesVariant variant{bounce == 0, is_last, is_last ? sources.cache.kind : IndirectCache::OFF,
                                      frame.plan.indirect.lights};
    pass.dispatch(frame.compute(variant), frame.size_px);
    paths.states = states;
    return rays;
}

// What finishing reads; its output follows.
PassRecorder& read_paths(PassRecorder& pass, const FrameContext& frame, const GBuffer& gbuffer,
                         const SampleSlot& slot, const Paths& paths) {
    if (paths.light_hits) pass.read(UNIT_PASS_C, paths.light_hits);
    if (paths.light_hits && paths.light_tree != nullptr) pass.read_table(UNIT_PASS_E, *paths.light_tree);
    return read_gbuffer(pass, gbuffer)
        .constants(constants_for(frame, slot, frame.plan.indirect.bounces - 1))
        .read(UNIT_PASS_A, paths.states)
        .read(UNIT_PASS_B, paths.answers)
        .count(BLOCK_COUNTERS, frame.counters);
}

PathSamplesVariant finishing_variant(const FrameContext& frame, const Paths& paths, bool shades) {
    const IndirectPlan& plan = frame.plan.indirect;
    return {plan.sampling, shades, plan.lights, paths.light_hits != nullptr};
}

}  // namespace

Paths trace_paths(const FrameContext& frame, const GBuffer& gbuffer, const SampleSlot& slot,
                  const PathSources& sources) {
    const std::size_t pixels = frame.pixel_count();
    Paths paths;
    paths.light_tree = sources.light_tree;
    Rows rays = write_first_rays(frame, gbuffer, slot, sources.blue_noise);
    for (int bounce = 0; bounce < frame.plan.indirect.bounces; ++bounce) {
        CoverageKey key = slot.shadow_key;
        if (bounce > 0) key.ray = RAY_BOUNCE + std::uint32_t(bounce);
        const Rows hits = trace_closest_hits(frame, "indirect/hits", rays, pixels, key);
        const VertexRays further = light_vertices(frame, slot, bounce, hits, sources, paths);
        paths.answers = trace_visibility(frame, "indirect/shadows", further.shadow, pixels, slot.shadow_key);
        rays = further.next;
    }
    if (rays) {
        CoverageKey key = slot.shadow_key;
        key.ray = RAY_BOUNCE + std::uint32_t(frame.plan.indirect.bounces);
        paths.light_hits = trace_closest_hits(frame, "indirect/light_hits", rays, pixels, key);
    }
    return paths;
}

Samples finish_samples(const FrameContext& frame, const GBuffer& gbuffer, const SampleSlot& slot,
                       const Paths& paths) {
    const Samples fresh{
        frame.take_pixel_rows("indirect/samples", RESERVOIR_ROWS + PATH_SAMPLE_ROWS, BufferUse::DEVICE),
        nullptr};
    PassRecorder pass = frame.pass("indirect/samples");
    read_paths(pass, frame, gbuffer, slot, paths)
        .write(0, fresh.reservoirs)
        .dispatch(frame.compute(finishing_variant(frame, paths, false)), frame.size_px);
    return fresh;
}

ReflectedLight finish_light(const FrameContext& frame, const GBuffer& gbuffer, const SampleSlot& slot,
                            const Paths& paths) {
    const ReflectedLight light = take_reflected_light(frame, "indirect/light");
    PassRecorder pass = frame.pass("indirect/samples");
    read_paths(pass, frame, gbuffer, slot, paths)
        .write_image(0, *light.diffuse)
        .write_image(1, *light.specular)
        .dispatch(frame.compute(finishing_variant(frame, paths, true)), frame.size_px);
    return light;
}

}  // namespace tarn
