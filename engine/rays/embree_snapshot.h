// The world at one moment as Embree sees it: a top level of instances, with meshes of its own where they
// deform.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "rays/embree_mesh.h"

namespace tarn {

// Meshes that never deform: shared by all snapshots of a world; null for the others.
using StaticMeshes = std::vector<std::unique_ptr<EmbreeMesh>>;

class EmbreeSnapshot {
  public:
    // Takes the world as it is. `static_meshes` must outlive the snapshot; `coverage_filter` is for meshes
    // with an alpha test, which `is_filtered` names.
    EmbreeSnapshot(RTCDevice device, const World& world, const StaticMeshes& static_meshes,
                   const std::vector<bool>& is_filtered, RTCFilterFunctionN coverage_filter);

    // Catches up with the world: refits what deformed, moves what moved since this snapshot last looked.
    void follow(const World& world);

    RTCScene scene() const { return top_.get(); }
    // The materials of that moment, which decide coverage.
    const std::vector<glm::uvec4>& material_rows() const { return material_rows_; }

  private:
    struct PlacedInstance {
        EmbreeGeometry geometry;
        std::optional<EmbreeMesh> flattened;
        std::uint64_t revision = 0;
    };

    RTCFilterFunctionN filter_of(std::uint32_t mesh) const;
    RTCScene scene_of(std::uint32_t mesh) const;
    void place_instance(const World& world, std::uint32_t index);
    void copy_materials(const World& world);

    RTCDevice device_;
    const StaticMeshes& static_meshes_;
    const std::vector<bool>& is_filtered_;
    RTCFilterFunctionN coverage_filter_;
    std::vector<std::unique_ptr<EmbreeMesh>> deforming_meshes_;  // null for the others
    std::vector<PlacedInstance> instances_;
    std::vector<glm::uvec4> material_rows_;
    std::uint64_t material_revision_ = 0;
    EmbreeScene top_;
};

}  // namespace tarn
