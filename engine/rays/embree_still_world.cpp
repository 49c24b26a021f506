#include "rays/embree_still_world.h"

namespace tarn {
namespace {

constexpr std::uint64_t UPDATES_TO_BUILD = 8;
// What has moved within these may be about to move again.
constexpr std::uint64_t UPDATES_TO_REST = 60;

}  // namespace

EmbreeStillWorld::EmbreeStillWorld(RTCDevice device, const World& world, const std::vector<bool>& is_filtered,
                                   RTCFilterFunctionN coverage_filter)
    : device_(device),
      is_filtered_(is_filtered),
      coverage_filter_(coverage_filter),
      rests_from_(world.instances.size(), 0) {
    for (const WorldInstance& instance : world.instances) revisions_.push_back(instance.revision);
    scene_ = build(world);
}

void EmbreeStillWorld::update(const World& world) {
    ++updates_;
    bool has_left = false;
    for (std::uint32_t i = 0; i < revisions_.size(); ++i) {
        const std::uint64_t revision = world.instances[i].revision;
        if (revisions_[i] != revision) rests_from_[i] = updates_ + UPDATES_TO_REST;
        revisions_[i] = revision;
        if (scene_->has(i) && !scene_->is_right(world, i)) has_left = true;
    }
    if (next_ && updates_ >= takes_over_) {
        scene_ = std::move(next_);
    } else if (!next_ && has_left) {
        next_ = build(world);
        takes_over_ = updates_ + UPDATES_TO_BUILD;
    }
}

std::shared_ptr<const EmbreeStillScene> EmbreeStillWorld::build(const World& world) const {
    std::vector<bool> takes(rests_from_.size());
    for (std::size_t i = 0; i < takes.size(); ++i) takes[i] = rests_from_[i] <= updates_;
    return std::make_shared<EmbreeStillScene>(device_, world, takes, is_filtered_, coverage_filter_);
}

}  // namespace tarn
