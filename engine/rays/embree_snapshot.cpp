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

EmbreeSnapshot::EmbreeSnapshot(RTCDevice device, const World& world,
                               std::shared_ptr<const EmbreeStillScene> still, StaticMeshes& static_meshes,
                               const std::vector<bool>& is_filtered, RTCFilterFunctionN coverage_filter)
    : device_(device),
      static_meshes_(static_meshes),
      is_filtered_(is_filtered),
      coverage_filter_(coverage_filter),
      still_geometry_(rtcNewGeometry(device, RTC_GEOMETRY_TYPE_INSTANCE)),
      top_(rtcNewScene(device)) {
    rtcSetSceneFlags(top_.get(), RTC_SCENE_FLAG_ROBUST | EMBREE_QUERY_FILTER | RTC_SCENE_FLAG_DYNAMIC);
    deforming_meshes_.resize(world.meshes.size());
    for (std::uint32_t i = 0; i < world.meshes.size(); ++i) {
        if (!world.meshes[i].deforms) continue;
        deforming_meshes_[i] = std::make_unique<EmbreeMesh>(device, world, world.meshes[i], filter_of(i));
    }
    instances_.resize(world.instances.size());
    const glm::mat4 identity(1.0f);
    rtcSetGeometryTransform(still_geometry_.get(), 0, RTC_FORMAT_FLOAT4X4_COLUMN_MAJOR, &identity[0][0]);
    rtcAttachGeometryByID(top_.get(), still_geometry_.get(), std::uint32_t(instances_.size()));
    follow(world, std::move(still));
}

void EmbreeSnapshot::follow(const World& world, std::shared_ptr<const EmbreeStillScene> still) {
    std::vector<bool> deformed(deforming_meshes_.size(), false);
    for (std::size_t i = 0; i < deforming_meshes_.size(); ++i) {
        if (deforming_meshes_[i]) deformed[i] = deforming_meshes_[i]->update(world, world.meshes[i]);
    }
    bool changed = take_still_scene(std::move(still));
    instanced_count_ = 0;
    left_count_ = 0;
    for (std::uint32_t i = 0; i < instances_.size(); ++i) {
        if (follow_instance(world, i, deformed[world.instances[i].mesh])) changed = true;
        if (instances_[i].is_placed) ++instanced_count_;
        if (instances_[i].has_left) ++left_count_;
    }
    copy_materials(world);
    if (changed && instanced_count_ > 0) rtcCommitScene(top_.get());
}

bool EmbreeSnapshot::take_still_scene(std::shared_ptr<const EmbreeStillScene> still) {
    if (still == still_) return false;
    still_ = std::move(still);
    rtcSetGeometryInstancedScene(still_geometry_.get(), still_->scene());
    rtcCommitGeometry(still_geometry_.get());
    return true;
}

bool EmbreeSnapshot::follow_instance(const World& world, std::uint32_t index, bool has_deformed) {
    PlacedInstance& placed = instances_[index];
    if (world.meshes[world.instances[index].mesh].triangle_count == 0) return false;
    const bool is_still = still_->is_right(world, index);
    placed.has_left = still_->has(index) && !is_still;
    if (is_still) {
        if (!placed.is_placed) return false;
        rtcDetachGeometry(top_.get(), index);
        placed.is_placed = false;
        return true;
    }
    if (placed.is_placed && !has_deformed && placed.revision == world.instances[index].revision) return false;
    place_instance(world, index);
    return true;
}

RTCFilterFunctionN EmbreeSnapshot::filter_of(std::uint32_t mesh) const {
    return is_filtered_[mesh] ? coverage_filter_ : nullptr;
}

RTCScene EmbreeSnapshot::scene_of(const World& world, std::uint32_t mesh) {
    if (deforming_meshes_[mesh]) return deforming_meshes_[mesh]->scene();
    return static_meshes_.scene(world, mesh);
}

void EmbreeSnapshot::place_instance(const World& world, std::uint32_t index) {
    const WorldInstance& source = world.instances[index];
    PlacedInstance& placed = instances_[index];
    if (!placed.geometry) placed.geometry.reset(rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_INSTANCE));
    glm::mat4 transform = source.world_from_object;
    RTCScene scene = scene_of(world, source.mesh);
    if (!is_invertible(transform)) {
        placed.flattened.emplace(device_, world, source, filter_of(source.mesh));
        scene = placed.flattened->scene();
        transform = glm::mat4(1.0f);
    }
    rtcSetGeometryInstancedScene(placed.geometry.get(), scene);
    rtcSetGeometryTransform(placed.geometry.get(), 0, RTC_FORMAT_FLOAT4X4_COLUMN_MAJOR, &transform[0][0]);
    rtcCommitGeometry(placed.geometry.get());
    if (!placed.is_placed) rtcAttachGeometryByID(top_.get(), placed.geometry.get(), index);
    placed.is_placed = true;
    placed.revision = source.revision;
}

void EmbreeSnapshot::copy_materials(const World& world) {
    if (material_revision_ == world.material_revision) return;
    material_revision_ = world.material_revision;
    material_rows_ = world.material_rows;
}

}  // namespace tarn
