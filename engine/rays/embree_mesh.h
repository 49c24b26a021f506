// One mesh of the world as an Embree scene of one geometry, over the world's own memory.
#pragma once

#include <cstdint>
#include <vector>

#include "rays/embree_handles.h"
#include "world/world.h"

namespace tarn {

class EmbreeMesh {
  public:
    // `coverage_filter` is null where no instance of the mesh has an alpha test.
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

    // Follows the mesh's vertices: refits where they moved, rebuilds where the memory did. True if anything
    // changed.
    bool update(const World& world, const WorldMesh& mesh);

  private:
    void create(RTCDevice device, const World& world, const WorldMesh& mesh, RTCFilterFunctionN filter);
    void share_memory(const World& world, const WorldMesh& mesh);
    void commit();

    EmbreeScene scene_;
    EmbreeGeometry geometry_;
    std::vector<glm::vec4> flattened_positions_;
    const void* vertices_ = nullptr;
    const void* triangles_ = nullptr;
    std::uint64_t revision_ = 0;
    bool refits_ = false;
};

}  // namespace tarn
