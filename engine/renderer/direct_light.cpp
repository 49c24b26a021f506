#include "renderer/direct_light.h"

#include <utility>

#include "shared/math/reservoir.h"

namespace tarn {
namespace {

constexpr glm::vec3 LUMINANCE_WEIGHTS(0.2126f, 0.7152f, 0.0722f);
// Each sample of a pixel meets partly covered surfaces with numbers of its own.
constexpr std::uint32_t SEED_STRIDE = 0x9e3779b9u;

RowBuffer make_reservoirs(const std::string& name, int width_px, int height_px) {
    return make_pixel_rows(name, width_px, height_px, RESERVOIR_ROWS, BufferUse::DEVICE);
}

// One target for the picture, or one a channel.
std::vector<glm::vec3> targets_of(const DirectSettings& settings) {
    if (!settings.per_channel) return {LUMINANCE_WEIGHTS};
    return {glm::vec3(1.0f, 0.0f, 0.0f), glm::vec3(0.0f, 1.0f, 0.0f), glm::vec3(0.0f, 0.0f, 1.0f)};
}

}  // namespace

DirectLight::Meaning::Meaning(const DirectFrame& direct)
    : target_weights(direct.target_weights),
      mis(direct.settings.mis),
      traces_in_mis(direct.settings.traces_in_mis()),
      visibility(direct.settings.visibility),
      discard_occluded(direct.settings.discard_occluded),
      filters_boiling(direct.settings.boiling_filter > 0.0) {}

DirectLight::Lane::Lane(int width_px, int height_px)
    : reservoirs([=] { return make_reservoirs("direct/reservoirs", width_px, height_px); }) {}

DirectLight::DirectLight(ProgramLibrary& programs, int width_px, int height_px)
    : width_px_(width_px),
      height_px_(height_px),
      scratch_{make_reservoirs("direct/scratch", width_px, height_px),
               make_reservoirs("direct/scratch", width_px, height_px)},
      candidates_(programs, width_px, height_px),
      initial_visibility_(programs, width_px, height_px),
      reuse_step_(programs, width_px, height_px),
      temporal_(reuse_step_),
      boiling_filter_(programs, width_px, height_px),
      spatial_(reuse_step_),
      visibility_(std::size_t(width_px) * std::size_t(height_px)),
      shade_(programs, width_px, height_px),
      programs_(programs) {}

const Texture2D& DirectLight::record(DirectFrame direct, const RowBuffer* light_tree) {
    const CandidateSources sources = find_sources(direct, light_tree);
    const std::uint32_t seed = direct.shadow_key.seed;
    for (int i = 0; i < direct.settings.sample_count(); ++i) {
        direct.sample = std::uint32_t(i);
        direct.shadow_key.seed = seed ^ (direct.sample * SEED_STRIDE);
        record_sample(direct, sources);
    }
    return shade_.radiance();
}

void DirectLight::record_sample(DirectFrame& direct, CandidateSources sources) {
    if (direct.settings.resamples() && direct.settings.brdf_candidate) {
        sources.brdf_hits = &trace_brdf(direct);
    }
    const std::vector<glm::vec3> targets = targets_of(direct.settings);
    while (lanes_.size() < targets.size()) lanes_.emplace_back(width_px_, height_px_);
    for (std::size_t lane = 0; lane < targets.size(); ++lane) {
        direct.target_weights = targets[lane];
        record_lane(direct, lane, sources);
    }
}

CandidateSources DirectLight::find_sources(const DirectFrame& direct, const RowBuffer* light_tree) {
    const DirectSettings& settings = direct.settings;
    CandidateSources sources;
    if (settings.selection() == LightSelection::TILES) {
        if (!light_tiles_) light_tiles_ = std::make_unique<LightTilesPass>(programs_);
        sources.tiles = &light_tiles_->record(direct);
    }
    if (settings.selection() == LightSelection::TREE) sources.tree = light_tree;
    return sources;
}

const RowBuffer& DirectLight::trace_brdf(const DirectFrame& direct) {
    if (!brdf_candidates_) {
        brdf_candidates_ = std::make_unique<BrdfCandidatesPass>(programs_, width_px_, height_px_);
    }
    const RowBuffer& hits = brdf_candidates_->record(direct);
    rays_.closest += brdf_candidates_->result().traced;
    rays_.shadow.rejected += brdf_candidates_->result().rejected;
    return hits;
}

void DirectLight::record_lane(const DirectFrame& direct, std::size_t lane, const CandidateSources& sources) {
    const DirectSettings& settings = direct.settings;
    const Candidates fresh = candidates_.record(direct, sources);
    if (settings.tests_fresh_samples()) {
        const RowBuffer& seen = trace(direct, "direct/initial_rays", fresh.rays);
        initial_visibility_.record(direct, fresh, seen);
    }
    const RowBuffer& chosen = settings.reuses() ? reuse(direct, lanes_[lane], fresh) : fresh.reservoirs;
    const bool first = direct.sample == 0 && lane == 0;
    if (settings.shades_all()) {
        shade_.record(direct, *light_, first);
        return;
    }
    const RowBuffer* seen =
        settings.traces_chosen_samples() ? &trace(direct, "visibility", fresh.rays) : nullptr;
    shade_.record(direct, chosen, seen, first);
}

// Whether the lane holds what the last frame found by this frame's rules. Other methods may have run since;
// and the tracer may have forgotten the geometry that the weights would ask for.
bool DirectLight::has_past(const DirectFrame& direct, const Lane& lane) {
    if (!direct.last_frame || lane.frame != direct.last_frame->key.frame) return false;
    if (lane.meaning != Meaning(direct)) return false;
    return !direct.settings.traces_in_mis() || direct.tracer.remembers(direct.last_frame->geometry_revision);
}

// The steps of reuse in turn. The last one writes the rays that test its samples; the last that feeds the
// history writes what the next frame will find.
const RowBuffer& DirectLight::reuse(const DirectFrame& direct, Lane& lane, const Candidates& fresh) {
    const DirectSettings& settings = direct.settings;
    const RowBuffer& kept = lane.reservoirs.current();
    const int spatial_steps = settings.reuses_space() ? settings.spatial_iterations : 0;
    const Buffer* last_rays = settings.traces_chosen_samples() ? &fresh.rays : nullptr;
    const RowBuffer* in = &fresh.reservoirs;
    if (settings.reuses_time()) {
        const bool last = spatial_steps == 0;
        const RowBuffer& out = last || !settings.feedback ? kept : scratch_[0];
        temporal_.record(direct, {*in, out, last ? last_rays : nullptr}, lane.reservoirs.previous(),
                         has_past(direct, lane));
        if (settings.boiling_filter > 0.0) boiling_filter_.record(direct, out);
        in = &out;
    }
    for (int i = 0; i < spatial_steps; ++i) {
        const bool last = i + 1 == spatial_steps;
        const bool is_kept = last && (settings.feedback || !settings.reuses_time());
        const RowBuffer& out = is_kept ? kept : scratch_[std::size_t(in == &scratch_[0] ? 1 : 0)];
        const bool lights = last && settings.shades_all();
        if (lights && !light_) light_.emplace("direct/light", width_px_, height_px_, GL_RGBA32F);
        spatial_.record(direct, {*in, out, last ? last_rays : nullptr, lights ? &*light_ : nullptr}, i);
        in = &out;
    }
    lane.frame = direct.shadow_key.frame;
    lane.meaning.emplace(direct);
    return *in;
}

const RowBuffer& DirectLight::trace(const DirectFrame& direct, const std::string& name, const Buffer& rays) {
    const std::size_t count = std::size_t(width_px_) * std::size_t(height_px_);
    const RowBuffer& answers =
        visibility_.record(direct.frame, name, direct.tracer, rays, count, direct.shadow_key);
    rays_.shadow.traced += visibility_.result().traced;
    rays_.shadow.rejected += visibility_.result().rejected;
    return answers;
}

void DirectLight::advance() {
    for (Lane& lane : lanes_) lane.reservoirs.advance();
}

DirectLight::Rays DirectLight::take_rays() {
    Rays rays = std::exchange(rays_, {});
    const RayBatchResult reuse = reuse_step_.take_result();
    rays.shadow.traced += reuse.traced;
    rays.shadow.rejected += reuse.rejected;
    return rays;
}

}  // namespace tarn
