// One mesh of the world as an Embree scene of one geometry.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "rays/embree_handles.h"
#include "world/world.h"

namespace tarn {

class EmbreeMesh {
  public:
    // `coverage_filter` is null where no instance of the mesh has an alpha test. A mesh that never deforms is
    // read where it lies in the world's memory; of one that does, a copy of its vertices is kept, so that
    // this object stays as it is when the world's vertices move.
    EmbreeMesh(RTCDevice device, const World& world, const WorldMesh& mesh,
               RTCFilterFunctionN coverage_filter);

    // A copy of the mesh with the transform multiplied in, for instances whose transform cannot be inverted.
    EmbreeMesh(RTCDevice device, const World& world, const WorldInstance& flattened,
               RTCFilterFunctionN coverage_filter);

    RTCScene scene() const { return scene_.get(); }

    // Whether triangles of the geometry with this user pointer are clockwise seen from their front.
    static bool is_winding_turned(const void* geometry_user_pointer) {
        return geometry_user_pointer != nullptr;
    }

    // Refits to the vertices of a mesh that deforms. True if anything changed.
    bool update(const World& world, const WorldMesh& mesh);

  private:
    void create(RTCDevice device, const World& world, const WorldMesh& mesh, RTCFilterFunctionN filter);
    void copy_positions(const World& world, const WorldMesh& mesh, const glm::mat4& transform);
    void share_memory(const World& world, const WorldMesh& mesh);
    void commit();

    EmbreeScene scene_;
    EmbreeGeometry geometry_;
    std::vector<glm::vec4> positions_;  // the copy, where there is one
    std::uint64_t revision_ = 0;
    bool refits_ = false;
};

// Meshes that never deform, each built when the first instance asks for it: those whose instances stand still
// are never asked for.
class StaticMeshes {
  public:
    // References must outlive this object.
    StaticMeshes(RTCDevice device, const std::vector<bool>& is_filtered, RTCFilterFunctionN coverage_filter)
        : device_(device), is_filtered_(is_filtered), coverage_filter_(coverage_filter) {}

    RTCScene scene(const World& world, std::uint32_t mesh);
    void clear() { meshes_.clear(); }

  private:
    RTCDevice device_;
    const std::vector<bool>& is_filtered_;
    RTCFilterFunctionN coverage_filter_;
    std::vector<std::unique_ptr<EmbreeMesh>> meshes_;  // null: nobody asked yet
};

}  // namespace tarn
