// Which instances stand still, followed from update to update, and the scene of those that do.
#pragma once

#include <memory>
#include <vector>

#include "rays/embree_still_scene.h"

namespace tarn {

// What moves leaves the still scene at once (EmbreeStillScene::is_right). So that rays need not look past the
// place that it left for long, a scene without it is built in the background and takes over a fixed number of
// updates later: on the clock of updates, not of the machine, so that the same frames give the same answers.
class EmbreeStillWorld {
  public:
    // References must outlive this object.
    EmbreeStillWorld(RTCDevice device, const World& world, const std::vector<bool>& is_filtered,
                     RTCFilterFunctionN coverage_filter);

    // Once for each update of the world, whether anything moved or not.
    void update(const World& world);

    const std::shared_ptr<const EmbreeStillScene>& scene() const { return scene_; }

  private:
    std::shared_ptr<const EmbreeStillScene> build(const World& world) const;

    RTCDevice device_;
    const std::vector<bool>& is_filtered_;
    RTCFilterFunctionN coverage_filter_;
    std::uint64_t updates_ = 0;
    std::vector<std::uint64_t> revisions_;   // of each instance, as last seen
    std::vector<std::uint64_t> rests_from_;  // the update from which on each counts as standing still
    std::shared_ptr<const EmbreeStillScene> scene_;
    std::shared_ptr<const EmbreeStillScene> next_;  // null: none is being built
    std::uint64_t takes_over_ = 0;                  // the update in which `next_` does
};

}  // namespace tarn
