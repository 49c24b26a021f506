// What stands still, as one Embree scene: the triangles of many instances, in world space under a single BVH.
// A ray meets them without going through instances, whose boxes overlap and each of which it would have to be
// transformed for.
#pragma once

#include <cstdint>
#include <future>
#include <vector>

#include "rays/embree_handles.h"
#include "world/world.h"

namespace tarn {

class EmbreeStillScene {
  public:
    // Of the instances that `takes` names, where they are now; geometry ids are their indices. What deforms
    // is never taken, nor more than MAX_TRIANGLES in all. Copies what it needs and builds in the background.
    // `coverage_filter` is for meshes with an alpha test, which `is_filtered` names.
    EmbreeStillScene(RTCDevice device, const World& world, const std::vector<bool>& takes,
                     const std::vector<bool>& is_filtered, RTCFilterFunctionN coverage_filter);
    ~EmbreeStillScene();

    // Copies of instances cost memory, about 100 bytes a triangle. Beyond this many only meshes of one
    // instance are taken, as long as there is room.
    static constexpr std::size_t MAX_TRIANGLES = 4'000'000;

    // Waits for the build.
    RTCScene scene() const;

    bool has(std::uint32_t instance) const { return revisions_[instance] != NOT_TAKEN; }
    // Whether it has the instance where it stands in `world`.
    bool is_right(const World& world, std::uint32_t instance) const {
        return revisions_[instance] == world.instances[instance].revision;
    }

  private:
    static constexpr std::uint64_t NOT_TAKEN = ~std::uint64_t(0);

    void add(RTCDevice device, const World& world, std::uint32_t index, RTCFilterFunctionN filter);

    EmbreeScene scene_;
    std::vector<std::uint64_t> revisions_;  // of each instance of the world
    mutable std::future<void> build_;
};

}  // namespace tarn
