// THE FRAME: from the scene's tables to radiance and what is shown of it, stage by stage. Each stage takes
// values and returns values; what the next frame finds is what `history_` keeps.
#include <utility>

#include "passes/antialias/antialias.h"
#include "passes/composite.h"
#include "passes/denoise/light_changes.h"
#include "passes/direct/brdf_candidates.h"
#include "passes/direct/candidates.h"
#include "passes/direct/light_tiles.h"
#include "passes/direct/reuse.h"
#include "passes/direct/shade.h"
#include "passes/enlarge.h"
#include "passes/indirect/cache.h"
#include "passes/indirect/coarse.h"
#include "passes/indirect/paths.h"
#include "passes/indirect/reuse.h"
#include "passes/indirect/shade.h"
#include "passes/trace_rays.h"
#include "renderer/renderer.h"
#include "shared/math/random.h"

namespace tarn {
namespace {

// Each sample of a pixel meets partly covered surfaces with numbers of its own.
constexpr std::uint32_t SEED_STRIDE = 0x9e3779b9u;

std::vector<SampleSlot> list_slots(const FrameContext& frame) {
    std::vector<SampleSlot> slots;
    for (std::uint32_t index = 0; index < std::uint32_t(frame.plan.direct.sample_count); ++index) {
        const CoverageKey key{frame.frame, frame.seed ^ (index * SEED_STRIDE), RAY_SHADOW};
        for (std::size_t lane = 0; lane < frame.plan.direct.targets.size(); ++lane) {
            slots.push_back({index, lane, frame.plan.direct.targets[lane], key});
        }
    }
    return slots;
}

}  // namespace

Renderer::Values Renderer::record_frame(const FrameContext& frame, const FrameInput& input) {
    const GBuffer gbuffer =
        gbuffer_.record(frame, world_, input.camera, find_previous(frame, history_.surfaces));
    const auto samples = find_previous_samples(frame);
    ReflectedLight direct = light_directly(frame, gbuffer);
    ReflectedLight indirect;
    if (frame.plan.indirect.runs) indirect = light_indirectly(frame, gbuffer);
    const Picture changes = samples ? compare_light(frame, gbuffer, *samples) : nullptr;
    if (frame.plan.denoise.runs) {
        direct = denoise(frame, gbuffer, {direct, std::exchange(indirect, {}), changes});
    }
    Picture radiance = finish(frame, gbuffer, {composite(frame, gbuffer, direct, indirect), changes});
    averaged_frames_ = 1;
    average_sums_ = nullptr;
    if (input.average) radiance = average(frame, radiance);
    history_.shown.keep(frame.frame, radiance);
    Picture display;
    if (input.display) display = show(frame, *input.display, radiance, gbuffer);
    history_.surfaces.keep(frame.frame, gbuffer.surfaces);
    return {gbuffer, radiance, display};
}

std::optional<Previous<KeptLight>> Renderer::find_previous_light(const FrameContext& frame) const {
    auto previous = find_previous(frame, history_.denoised);
    if (previous && previous->value().meaning != denoise_meaning(frame.plan)) return std::nullopt;
    return previous;
}

// The last frame's light samples, where this one compares them with its own.
std::optional<Previous<KeptSamples>> Renderer::find_previous_samples(const FrameContext& frame) const {
    if (!frame.plan.denoise.adapts || !gpu_scene_.is_changing() || history_.direct.empty())
        return std::nullopt;
    auto previous = find_previous(frame, history_.direct.front());
    const DirectPlan& plan = frame.plan.direct;
    if (!previous || previous->value().meaning != meaning_of(plan.reuse, plan.targets.front()))
        return std::nullopt;
    const bool asks_rays = frame.plan.denoise.light_samples.asks_rays;
    if (asks_rays && !frame.tracer.remembers(frame.previous->geometry_revision)) return std::nullopt;
    return previous;
}

Picture Renderer::compare_light(const FrameContext& frame, const GBuffer& gbuffer,
                                const Previous<KeptSamples>& samples) const {
    const auto present = history_.direct.front().of_frame(frame.frame);
    return present ? find_light_changes(frame, gbuffer, samples, present->value()) : nullptr;
}

// Of both stages as one.
ReflectedLight Renderer::denoise(const FrameContext& frame, const GBuffer& gbuffer, const NoisyLight& noisy) {
    KeptLight kept;
    const ReflectedLight light = denoiser_.record(frame, gbuffer, noisy, find_previous_light(frame), kept);
    history_.denoised.keep(frame.frame, std::move(kept));
    return light;
}

// At the size of what is shown.
Picture Renderer::finish(const FrameContext& frame, const GBuffer& gbuffer, const AntialiasInput& input) {
    if (!frame.plan.antialias.runs) return enlarge(frame, input.radiance);
    KeptPicture kept = antialias(frame, gbuffer, input, find_previous(frame, history_.picture));
    const Picture shown = kept.shown;
    history_.picture.keep(frame.frame, std::move(kept));
    return shown;
}

// What moves starts over.
Picture Renderer::average(const FrameContext& frame, const Picture& radiance) {
    auto previous = find_previous(frame, history_.averaged);
    if (frame.has_moved) previous.reset();
    AveragedPicture average = average_frames(frame, radiance, previous, find_previous(frame, history_.shown));
    averaged_frames_ = average.averaged.frames;
    average_sums_ = average.sums;
    history_.averaged.keep(frame.frame, std::move(average.averaged));
    return average.shown;
}

Picture Renderer::show(const FrameContext& frame, const DisplayInput& input, const Picture& radiance,
                       const GBuffer& gbuffer) {
    exposure_ = find_exposure(frame, radiance, input.exposure, find_previous(frame, history_.exposure));
    history_.exposure.keep(frame.frame, exposure_);
    return show_frame(frame, input.choice, radiance, gbuffer, exposure_);
}

ReflectedLight Renderer::light_directly(const FrameContext& frame, const GBuffer& gbuffer) {
    const DirectPlan& plan = frame.plan.direct;
    const ReusePlan& reuse = plan.reuse;
    const std::size_t pixels = frame.pixel_count();
    history_.direct.resize(plan.targets.size());

    CandidateSources sources;
    sources.tree = find_light_tree(plan.light_tree);
    if (plan.light_tiles) sources.tiles = draw_light_tiles(frame);

    ReflectedLight light;
    for (const SampleSlot& slot : list_slots(frame)) {
        if (plan.brdf_rays && slot.lane == 0) {
            sources.brdf_hits = trace_brdf_candidates(frame, gbuffer, slot);
        }
        Samples fresh = choose_candidates(frame, gbuffer, slot, sources);
        if (reuse.tests_fresh_samples) {
            const Answers seen =
                trace_visibility(frame, "direct/initial_rays", fresh.rays, pixels, slot.shadow_key);
            fresh = apply_direct_visibility(frame, std::move(fresh), seen);
        }

        History<KeptSamples>& kept = history_.direct[slot.lane];
        const ReusedSamples reused = reuse_samples(frame, direct_reuse(frame), gbuffer, slot, fresh, kept);
        // Without reuse the next frame still compares light by them. Whether it does is known only then.
        if (!reuse.runs() && frame.plan.denoise.mode == DenoiseMode::SVGF && slot.index == 0) {
            kept.keep(frame.frame, {fresh.reservoirs, meaning_of(reuse, slot.target_weights)});
        }
        if (plan.is_lit_by_reuse()) return reused.light;
        Answers seen;
        if (reuse.tests_chosen_samples) {
            seen = trace_visibility(frame, "visibility", reused.samples.rays, pixels, slot.shadow_key);
        }
        light = shade_direct(frame, gbuffer, slot, {&reused.samples, seen, reused.light}, light);
    }
    return light;
}

ReflectedLight Renderer::light_indirectly(const FrameContext& frame, const GBuffer& gbuffer) {
    if (frame.plan.indirect.step_px > 1) return light_coarsely(frame, gbuffer);
    return light_by_paths(frame, gbuffer);
}

// Samples of another step are no history (SampleMeaning), and so neither are its surfaces.
ReflectedLight Renderer::light_coarsely(const FrameContext& frame, const GBuffer& gbuffer) {
    FrameContext coarse = frame;
    coarse.size_px = coarse_size_px(frame.size_px, frame.plan.indirect.step_px);
    recorder_.bind_frame_block(coarse_frame_block_);
    const GBuffer thinned{nullptr, gbuffer_.take_surfaces(coarse.size_px),
                          find_previous(frame, history_.coarse_surfaces)};
    thin_surfaces(coarse, gbuffer, *thinned.surfaces);
    const ReflectedLight light = light_by_paths(coarse, thinned);
    history_.coarse_surfaces.keep(frame.frame, thinned.surfaces);
    const ReflectedLight upsampled = upsample(frame, gbuffer, *thinned.surfaces, light);
    recorder_.bind_frame_block(frame_block_);
    return upsampled;
}

ReflectedLight Renderer::light_by_paths(const FrameContext& frame, const GBuffer& gbuffer) {
    const IndirectPlan& plan = frame.plan.indirect;
    const SampleSlot slot{0, 0, plan.targets[0], {frame.frame, frame.seed, RAY_SHADOW}};
    const PathCache cache = find_path_cache(frame, gbuffer, find_previous(frame, history_.indirect_light),
                                            find_previous(frame, history_.cache_cells));
    const PathSources sources{find_blue_noise(), find_light_tree(plan.lights == PathLights::TREE), cache};
    const Paths paths = trace_paths(frame, gbuffer, slot, sources);
    if (plan.cache == IndirectCache::WORLD) {
        history_.cache_cells.keep(
            frame.frame, update_cells(frame, slot, paths.states,
                                      {cache.cells, sources.light_tree, estimate_irradiance(world_)}));
    }
    const ReflectedLight light = finish_paths(frame, gbuffer, slot, paths);
    if (plan.cache == IndirectCache::SCREEN) history_.indirect_light.keep(frame.frame, light.diffuse);
    return light;
}

ReflectedLight Renderer::finish_paths(const FrameContext& frame, const GBuffer& gbuffer, SampleSlot slot,
                                      const Paths& paths) {
    const IndirectPlan& plan = frame.plan.indirect;
    if (!plan.keeps_samples) return finish_light(frame, gbuffer, slot, paths);
    history_.indirect.resize(plan.targets.size());
    ReflectedLight light;
    for (slot.lane = 0; slot.lane < plan.targets.size(); ++slot.lane) {
        slot.target_weights = plan.targets[slot.lane];
        light = reuse_paths(frame, gbuffer, slot, finish_samples(frame, gbuffer, slot, paths), light);
    }
    if (tests_lamps(frame)) history_.paths_may_be_stale = false;
    return light;
}

ReflectedLight Renderer::reuse_paths(const FrameContext& frame, const GBuffer& gbuffer,
                                     const SampleSlot& slot, const Samples& fresh,
                                     const ReflectedLight& earlier) {
    const ReusedSamples reused =
        reuse_samples(frame, indirect_reuse(frame), gbuffer, slot, fresh, history_.indirect[slot.lane]);
    if (frame.plan.indirect.is_lit_by_reuse()) return reused.light;
    Answers seen;
    // Without anything merged the samples are fresh: their pixels see them.
    if (frame.plan.indirect.reuse.tests_chosen_samples && reused.samples.rays && !reused.light) {
        seen = trace_visibility(frame, "indirect/visibility", reused.samples.rays, frame.pixel_count(),
                                slot.shadow_key);
    }
    return shade_indirect(frame, gbuffer, slot, {&reused.samples, seen, reused.light}, earlier);
}

}  // namespace tarn
