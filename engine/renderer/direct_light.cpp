#include "renderer/direct_light.h"

#include "shared/math/reservoir.h"

namespace tarn {
namespace {

constexpr glm::vec3 LUMINANCE_WEIGHTS(0.2126f, 0.7152f, 0.0722f);

RowBuffer make_reservoirs(const std::string& name, int width_px, int height_px) {
    return make_pixel_rows(name, width_px, height_px, RESERVOIR_ROWS, BufferUse::DEVICE);
}

// One target for the picture, or one a channel.
std::vector<glm::vec3> targets_of(const DirectSettings& settings) {
    if (!settings.per_channel) return {LUMINANCE_WEIGHTS};
    return {glm::vec3(1.0f, 0.0f, 0.0f), glm::vec3(0.0f, 1.0f, 0.0f), glm::vec3(0.0f, 0.0f, 1.0f)};
}

}  // namespace

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
      spatial_(reuse_step_),
      visibility_(std::size_t(width_px) * std::size_t(height_px)),
      shade_(programs, width_px, height_px),
      programs_(programs) {}

const Texture2D& DirectLight::record(DirectFrame direct) {
    const std::vector<glm::vec3> targets = targets_of(direct.settings);
    const RowBuffer* tiles = nullptr;
    if (direct.settings.selection() == LightSelection::TILES) {
        if (!light_tiles_) light_tiles_ = std::make_unique<LightTilesPass>(programs_);
        tiles = &light_tiles_->record(direct);
    }
    while (lanes_.size() < targets.size()) lanes_.emplace_back(width_px_, height_px_);
    for (std::size_t lane = 0; lane < targets.size(); ++lane) {
        direct.target_weights = targets[lane];
        record_lane(direct, lane, tiles);
    }
    return shade_.radiance();
}

void DirectLight::record_lane(const DirectFrame& direct, std::size_t lane, const RowBuffer* tiles) {
    const DirectSettings& settings = direct.settings;
    const Candidates fresh = candidates_.record(direct, tiles);
    if (settings.tests_fresh_samples()) {
        const RowBuffer& seen = trace(direct, "direct/initial_rays", fresh.rays);
        initial_visibility_.record(direct, fresh, seen);
    }
    const RowBuffer& chosen = settings.reuses() ? reuse(direct, lanes_[lane], fresh) : fresh.reservoirs;
    const RowBuffer* seen =
        settings.traces_chosen_samples() ? &trace(direct, "visibility", fresh.rays) : nullptr;
    shade_.record(direct, chosen, seen, lane == 0);
}

// The steps of reuse in turn; the last one writes what the next frame will find, and the rays that test it.
const RowBuffer& DirectLight::reuse(const DirectFrame& direct, Lane& lane, const Candidates& fresh) {
    const DirectSettings& settings = direct.settings;
    const RowBuffer& result = lane.reservoirs.current();
    const int spatial_steps = settings.reuses_space() ? settings.spatial_iterations : 0;
    const Buffer* last_rays = settings.traces_chosen_samples() ? &fresh.rays : nullptr;
    const RowBuffer* in = &fresh.reservoirs;
    if (settings.reuses_time()) {
        const bool last = spatial_steps == 0;
        const RowBuffer& out = last ? result : scratch_[0];
        temporal_.record(direct, {*in, out, last ? last_rays : nullptr}, lane.reservoirs.previous());
        in = &out;
    }
    for (int i = 0; i < spatial_steps; ++i) {
        const bool last = i + 1 == spatial_steps;
        const RowBuffer& out = last ? result : scratch_[std::size_t(in == &scratch_[0] ? 1 : 0)];
        spatial_.record(direct, {*in, out, last ? last_rays : nullptr}, i);
        in = &out;
    }
    return result;
}

const RowBuffer& DirectLight::trace(const DirectFrame& direct, const std::string& name, const Buffer& rays) {
    const std::size_t count = std::size_t(width_px_) * std::size_t(height_px_);
    const RowBuffer& answers =
        visibility_.record(direct.frame, name, direct.tracer, rays, count, direct.shadow_key);
    result_.traced += visibility_.result().traced;
    result_.rejected += visibility_.result().rejected;
    return answers;
}

void DirectLight::advance() {
    for (Lane& lane : lanes_) lane.reservoirs.advance();
}

RayBatchResult DirectLight::take_result() {
    RayBatchResult result = reuse_step_.take_result();
    result.traced += result_.traced;
    result.rejected += result_.rejected;
    result_ = {};
    return result;
}

}  // namespace tarn
