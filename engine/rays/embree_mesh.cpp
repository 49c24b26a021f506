#include "rays/embree_mesh.h"

namespace tarn {

EmbreeMesh::EmbreeMesh(RTCDevice device, const World& world, const WorldMesh& mesh,
                       RTCFilterFunctionN coverage_filter) {
    if (mesh.deforms) copy_positions(world, mesh, glm::mat4(1.0f));
    create(device, world, mesh, coverage_filter);
}

EmbreeMesh::EmbreeMesh(RTCDevice device, const World& world, const WorldInstance& flattened,
                       RTCFilterFunctionN coverage_filter) {
    const WorldMesh& mesh = world.meshes[flattened.mesh];
    copy_positions(world, mesh, flattened.world_from_object);
    create(device, world, mesh, coverage_filter);
    // Any pointer but null, see is_winding_turned.
    if (geometry_ && flattened.mirrored) rtcSetGeometryUserData(geometry_.get(), geometry_.get());
}

void EmbreeMesh::copy_positions(const World& world, const WorldMesh& mesh, const glm::mat4& transform) {
    positions_.resize(mesh.vertex_count);
    for (std::uint32_t v = 0; v < mesh.vertex_count; ++v) {
        const std::size_t row = std::size_t(mesh.first_vertex + v) * VERTEX_ROWS;
        positions_[v] = transform * glm::vec4(row_xyz(world.vertex_rows[row]), 1.0f);
    }
}

void EmbreeMesh::create(RTCDevice device, const World& world, const WorldMesh& mesh,
                        RTCFilterFunctionN filter) {
    scene_.reset(rtcNewScene(device));
    // The robust flag closes the gaps between neighbouring triangles; the context filter passes back faces.
    rtcSetSceneFlags(scene_.get(), RTC_SCENE_FLAG_ROBUST | EMBREE_QUERY_FILTER);
    if (mesh.triangle_count > 0) {
        geometry_.reset(rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE));
        rtcSetGeometryIntersectFilterFunction(geometry_.get(), filter);
        rtcSetGeometryOccludedFilterFunction(geometry_.get(), filter);
        rtcAttachGeometryByID(scene_.get(), geometry_.get(), 0);
        share_memory(world, mesh);
    }
    revision_ = mesh.revision;
    commit();
}

// The world's vertex rows are 64 bytes apart and begin with the position, so Embree reads them where they
// lie. Of each it loads 16 bytes, one row.
void EmbreeMesh::share_memory(const World& world, const WorldMesh& mesh) {
    rtcSetSharedGeometryBuffer(geometry_.get(), RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                               &world.triangles[mesh.first_triangle], 0, sizeof(glm::uvec3),
                               mesh.triangle_count);
    const void* rows = &world.vertex_rows[std::size_t(mesh.first_vertex) * VERTEX_ROWS];
    const bool copied = !positions_.empty();
    rtcSetSharedGeometryBuffer(
        geometry_.get(), RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, copied ? positions_.data() : rows, 0,
        copied ? sizeof(glm::vec4) : VERTEX_ROWS * sizeof(glm::uvec4), mesh.vertex_count);
}

bool EmbreeMesh::update(const World& world, const WorldMesh& mesh) {
    if (!geometry_ || revision_ == mesh.revision) return false;
    if (!refits_) {
        // Embree refits in scenes of low build quality alone; this commit rebuilds, all later ones refit.
        rtcSetSceneFlags(scene_.get(), rtcGetSceneFlags(scene_.get()) | RTC_SCENE_FLAG_DYNAMIC);
        rtcSetSceneBuildQuality(scene_.get(), RTC_BUILD_QUALITY_LOW);
        rtcSetGeometryBuildQuality(geometry_.get(), RTC_BUILD_QUALITY_REFIT);
        refits_ = true;
    }
    copy_positions(world, mesh, glm::mat4(1.0f));
    rtcUpdateGeometryBuffer(geometry_.get(), RTC_BUFFER_TYPE_VERTEX, 0);
    revision_ = mesh.revision;
    commit();
    return true;
}

void EmbreeMesh::commit() {
    if (geometry_) rtcCommitGeometry(geometry_.get());
    rtcCommitScene(scene_.get());
}

RTCScene StaticMeshes::scene(const World& world, std::uint32_t mesh) {
    meshes_.resize(world.meshes.size());
    std::unique_ptr<EmbreeMesh>& found = meshes_[mesh];
    if (!found) {
        found = std::make_unique<EmbreeMesh>(device_, world, world.meshes[mesh],
                                             is_filtered_[mesh] ? coverage_filter_ : nullptr);
    }
    return found->scene();
}

}  // namespace tarn
