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
    Rows next;  // null: the path ends here
};

VertexRays light_vertices(const FrameContext& frame, const SampleSlot& slot, int bounce, const Rows& hits,
                          const PathCache& cache, Paths& paths) {
    const bool is_last = bounce + 1 == frame.plan.indirect.bounces;
    VertexRays rays;
    rays.shadow = frame.take_pixel_rows("indirect/shadow_rays", RAY_ROWS, BufferUse::SHARED);
    if (!is_last) rays.next = frame.take_pixel_rows("indirect/rays", RAY_ROWS, BufferUse::SHARED);
    const Rows states = frame.take_pixel_rows("indirect/path_states", PATH_STATE_ROWS, BufferUse::DEVICE);
    PassRecorder pass = frame.pass("indirect/vertices");
    pass.constants(constants_for(frame, slot, bounce))
        .read(UNIT_PASS_A, hits)
        .write(0, states)
        .write(1, rays.shadow)
        .count(BLOCK_COUNTERS, frame.counters);
    if (bounce > 0) pass.read(UNIT_PASS_B, paths.answers).read(UNIT_PASS_C, paths.states);
    if (rays.next) pass.write(2, rays.next);
    if (is_last) read_path_cache(pass, cache);
    const IndirectCache asked = is_last ? cache.kind : IndirectCache::OFF;
    pass.dispatch(frame.compute(PathVerticesVariant{bounce == 0, is_last, asked}), frame.size_px);
    paths.states = states;
    return rays;
}

// What finishing reads; its output follows.
PassRecorder& read_paths(PassRecorder& pass, const FrameContext& frame, const GBuffer& gbuffer,
                         const SampleSlot& slot, const Paths& paths) {
    return read_gbuffer(pass, gbuffer)
        .constants(constants_for(frame, slot, frame.plan.indirect.bounces - 1))
        .read(UNIT_PASS_A, paths.states)
        .read(UNIT_PASS_B, paths.answers)
        .count(BLOCK_COUNTERS, frame.counters);
}

}  // namespace

Paths trace_paths(const FrameContext& frame, const GBuffer& gbuffer, const SampleSlot& slot,
                  const RowBuffer* blue_noise, const PathCache& cache) {
    const std::size_t pixels = frame.pixel_count();
    Paths paths;
    Rows rays = write_first_rays(frame, gbuffer, slot, blue_noise);
    for (int bounce = 0; bounce < frame.plan.indirect.bounces; ++bounce) {
        CoverageKey key = slot.shadow_key;
        if (bounce > 0) key.ray = RAY_BOUNCE + std::uint32_t(bounce);
        const Rows hits = trace_closest_hits(frame, "indirect/hits", rays, pixels, key);
        const VertexRays further = light_vertices(frame, slot, bounce, hits, cache, paths);
        paths.answers = trace_visibility(frame, "indirect/shadows", further.shadow, pixels, slot.shadow_key);
        rays = further.next;
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
        .dispatch(frame.compute(PathSamplesVariant{frame.plan.indirect.sampling, false}), frame.size_px);
    return fresh;
}

ReflectedLight finish_light(const FrameContext& frame, const GBuffer& gbuffer, const SampleSlot& slot,
                            const Paths& paths) {
    const ReflectedLight light = take_reflected_light(frame, "indirect/light");
    PassRecorder pass = frame.pass("indirect/samples");
    read_paths(pass, frame, gbuffer, slot, paths)
        .write_image(0, *light.diffuse)
        .write_image(1, *light.specular)
        .dispatch(frame.compute(PathSamplesVariant{frame.plan.indirect.sampling, true}), frame.size_px);
    return light;
}

}  // namespace tarn
