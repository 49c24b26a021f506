#include "rays/embree_snapshot.h"

#include <cmath>

namespace tarn {
namespace {

// Whether Embree can take a ray into the instance's object space without losing its digits.
bool is_invertible(const glm::mat4& world_from_object) {
    const glm::dmat3 m(world_from_object);
    const double longest = glm::length(m[0]) * glm::length(m[1]) * glm::length(m[2]);
    return std::abs(glm::determinant(m)) > 1e-5 * longest;
}

}  // namespace

EmbreeSnapshot::EmbreeSnapshot(RTCDevice device, const World& world, const StaticMeshes& static_meshes,
                               const std::vector<bool>& is_filtered, RTCFilterFunctionN coverage_filter)
    : device_(device),
      static_meshes_(static_meshes),
      is_filtered_(is_filtered),
      coverage_filter_(coverage_filter),
      top_(rtcNewScene(device)) {
    rtcSetSceneFlags(top_.get(), RTC_SCENE_FLAG_ROBUST | EMBREE_QUERY_FILTER | RTC_SCENE_FLAG_DYNAMIC);
    deforming_meshes_.resize(world.meshes.size());
    for (std::uint32_t i = 0; i < world.meshes.size(); ++i) {
        if (!world.meshes[i].deforms) continue;
        deforming_meshes_[i] = std::make_unique<EmbreeMesh>(device, world, world.meshes[i], filter_of(i));
    }
    instances_.resize(world.instances.size());
    for (std::uint32_t i = 0; i < instances_.size(); ++i) {
        instances_[i].geometry.reset(rtcNewGeometry(device, RTC_GEOMETRY_TYPE_INSTANCE));
        rtcAttachGeometryByID(top_.get(), instances_[i].geometry.get(), i);
        place_instance(world, i);
    }
    copy_materials(world);
    rtcCommitScene(top_.get());
}

void EmbreeSnapshot::follow(const World& world) {
    std::vector<bool> deformed(deforming_meshes_.size(), false);
    for (std::size_t i = 0; i < deforming_meshes_.size(); ++i) {
        if (deforming_meshes_[i]) deformed[i] = deforming_meshes_[i]->update(world, world.meshes[i]);
    }
    bool changed = false;
    for (std::uint32_t i = 0; i < instances_.size(); ++i) {
        const WorldInstance& source = world.instances[i];
        if (!deformed[source.mesh] && instances_[i].revision == source.revision) continue;
        place_instance(world, i);
        changed = true;
    }
    copy_materials(world);
    if (changed) rtcCommitScene(top_.get());
}

RTCFilterFunctionN EmbreeSnapshot::filter_of(std::uint32_t mesh) const {
    return is_filtered_[mesh] ? coverage_filter_ : nullptr;
}

RTCScene EmbreeSnapshot::scene_of(std::uint32_t mesh) const {
    return (static_meshes_[mesh] ? static_meshes_ : deforming_meshes_)[mesh]->scene();
}

void EmbreeSnapshot::place_instance(const World& world, std::uint32_t index) {
    const WorldInstance& source = world.instances[index];
    PlacedInstance& placed = instances_[index];
    glm::mat4 transform = source.world_from_object;
    RTCScene scene = scene_of(source.mesh);
    if (!is_invertible(transform)) {
        placed.flattened.emplace(device_, world, source, filter_of(source.mesh));
        scene = placed.flattened->scene();
        transform = glm::mat4(1.0f);
    }
    rtcSetGeometryInstancedScene(placed.geometry.get(), scene);
    rtcSetGeometryTransform(placed.geometry.get(), 0, RTC_FORMAT_FLOAT4X4_COLUMN_MAJOR, &transform[0][0]);
    rtcCommitGeometry(placed.geometry.get());
    placed.revision = source.revision;
}

void EmbreeSnapshot::copy_materials(const World& world) {
    if (material_revision_ == world.material_revision) return;
    material_revision_ = world.material_revision;
    material_rows_ = world.material_rows;
}

}  // namespace tarn
