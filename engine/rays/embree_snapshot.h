// The world at one moment as Embree sees it: what stands still in one BVH, and instances of whatever moves,
// with meshes of its own where they deform.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "rays/embree_mesh.h"
#include "rays/embree_still_scene.h"

namespace tarn {

class EmbreeSnapshot {
  public:
    // Takes the world as it is; `still` has instances of it. `static_meshes`, shared by all snapshots of a
    // world, must outlive the snapshot; `coverage_filter` is for meshes with an alpha test, which
    // `is_filtered` names.
    EmbreeSnapshot(RTCDevice device, const World& world, std::shared_ptr<const EmbreeStillScene> still,
                   StaticMeshes& static_meshes, const std::vector<bool>& is_filtered,
                   RTCFilterFunctionN coverage_filter);

    // Catches up with the world: refits what deformed, moves what moved since this snapshot last looked, or
    // takes it from `still`.
    void follow(const World& world, std::shared_ptr<const EmbreeStillScene> still);

    RTCScene scene() const { return instanced_count_ == 0 ? still_->scene() : top_.get(); }

    // Which instance a hit of a ray in scene() lies on. `instance_id`: of the outermost level.
    std::uint32_t instance_of(std::uint32_t instance_id, std::uint32_t geometry_id) const {
        return instance_id < instances_.size() ? instance_id : geometry_id;
    }
    // Whether there are instances that have left their place in the still scene: hits there are none.
    bool has_left() const { return left_count_ > 0; }
    // Whether this hit is such a one.
    bool is_left(std::uint32_t instance_id, std::uint32_t geometry_id) const {
        return instance_id >= instances_.size() && instances_[geometry_id].has_left;
    }
    // The materials of that moment, which decide coverage.
    const std::vector<glm::uvec4>& material_rows() const { return material_rows_; }

  private:
    struct PlacedInstance {
        EmbreeGeometry geometry;
        std::optional<EmbreeMesh> flattened;
        std::uint64_t revision = 0;
        bool is_placed = false;  // it is an instance of the top level
        bool has_left = false;   // the still scene has it where it is no more
    };

    RTCFilterFunctionN filter_of(std::uint32_t mesh) const;
    RTCScene scene_of(const World& world, std::uint32_t mesh);
    void place_instance(const World& world, std::uint32_t index);
    // Both tell whether the top level changed.
    bool follow_instance(const World& world, std::uint32_t index, bool has_deformed);
    bool take_still_scene(std::shared_ptr<const EmbreeStillScene> still);
    void copy_materials(const World& world);

    RTCDevice device_;
    StaticMeshes& static_meshes_;
    const std::vector<bool>& is_filtered_;
    RTCFilterFunctionN coverage_filter_;
    std::vector<std::unique_ptr<EmbreeMesh>> deforming_meshes_;  // null for the others
    std::shared_ptr<const EmbreeStillScene> still_;
    EmbreeGeometry still_geometry_;  // the still scene as an instance, whose id is beyond all others
    std::vector<PlacedInstance> instances_;
    std::size_t instanced_count_ = 0;
    std::size_t left_count_ = 0;
    std::vector<glm::uvec4> material_rows_;
    std::uint64_t material_revision_ = 0;
    EmbreeScene top_;
};

}  // namespace tarn
