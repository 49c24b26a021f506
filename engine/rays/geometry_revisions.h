// What of a world has changed since a tracer last looked: everything that decides what a ray meets.
#pragma once

#include <cstdint>
#include <vector>

#include "world/world.h"

namespace tarn {

struct GeometryRevisions {
    std::vector<std::uint64_t> meshes;
    std::vector<std::uint64_t> instances;
    std::uint64_t materials = 0;

    bool operator==(const GeometryRevisions&) const = default;
};

inline GeometryRevisions geometry_revisions_of(const World& world) {
    GeometryRevisions result;
    for (const WorldMesh& mesh : world.meshes) result.meshes.push_back(mesh.revision);
    for (const WorldInstance& instance : world.instances) result.instances.push_back(instance.revision);
    result.materials = world.material_revision;
    return result;
}

}  // namespace tarn
