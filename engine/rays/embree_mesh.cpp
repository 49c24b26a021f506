#include "rays/embree_mesh.h"

namespace tarn {

EmbreeMesh::EmbreeMesh(RTCDevice device, const World& world, const WorldMesh& mesh,
                       RTCFilterFunctionN coverage_filter) {
    create(device, world, mesh, coverage_filter);
}

EmbreeMesh::EmbreeMesh(RTCDevice device, const World& world, const WorldInstance& flattened,
                       RTCFilterFunctionN coverage_filter) {
    const WorldMesh& mesh = world.meshes[flattened.mesh];
    flattened_positions_.reserve(mesh.vertex_count);
    for (std::uint32_t v = 0; v < mesh.vertex_count; ++v) {
        const std::size_t row = std::size_t(mesh.first_vertex + v) * VERTEX_ROWS;
        flattened_positions_.push_back(flattened.world_from_object *
                                       glm::vec4(row_xyz(world.vertex_rows[row]), 1.0f));
    }
    create(device, world, mesh, coverage_filter);
    // Any pointer but null, see is_winding_turned.
    if (geometry_ && flattened.mirrored) rtcSetGeometryUserData(geometry_.get(), geometry_.get());
}

void EmbreeMesh::create(RTCDevice device, const World& world, const WorldMesh& mesh,
                        RTCFilterFunctionN filter) {
    scene_.reset(rtcNewScene(device));
    // The robust flag closes the gaps between neighbouring triangles; the context filter passes back faces.
    rtcSetSceneFlags(scene_.get(), RTC_SCENE_FLAG_ROBUST | RTC_SCENE_FLAG_CONTEXT_FILTER_FUNCTION);
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

// Vertex rows are 64 bytes apart and begin with the position, so Embree reads them where they lie. Of each it
// loads 16 bytes, one row.
void EmbreeMesh::share_memory(const World& world, const WorldMesh& mesh) {
    triangles_ = &world.triangles[mesh.first_triangle];
    rtcSetSharedGeometryBuffer(geometry_.get(), RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, triangles_, 0,
                               sizeof(glm::uvec3), mesh.triangle_count);
    vertices_ = &world.vertex_rows[std::size_t(mesh.first_vertex) * VERTEX_ROWS];
    const bool flattened = !flattened_positions_.empty();
    rtcSetSharedGeometryBuffer(geometry_.get(), RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                               flattened ? flattened_positions_.data() : vertices_, 0,
                               flattened ? sizeof(glm::vec4) : VERTEX_ROWS * sizeof(glm::uvec4),
                               mesh.vertex_count);
}

bool EmbreeMesh::update(const World& world, const WorldMesh& mesh) {
    if (!geometry_) return false;
    const bool moved_memory = triangles_ != &world.triangles[mesh.first_triangle] ||
                              vertices_ != &world.vertex_rows[std::size_t(mesh.first_vertex) * VERTEX_ROWS];
    const bool deformed = revision_ != mesh.revision;
    if (!moved_memory && !deformed) return false;
    if (deformed && !refits_) {
        // Embree refits in scenes of low build quality alone; this commit rebuilds, all later ones refit.
        rtcSetSceneFlags(scene_.get(), rtcGetSceneFlags(scene_.get()) | RTC_SCENE_FLAG_DYNAMIC);
        rtcSetSceneBuildQuality(scene_.get(), RTC_BUILD_QUALITY_LOW);
        rtcSetGeometryBuildQuality(geometry_.get(), RTC_BUILD_QUALITY_REFIT);
        refits_ = true;
    }
    if (moved_memory) share_memory(world, mesh);
    rtcUpdateGeometryBuffer(geometry_.get(), RTC_BUFFER_TYPE_VERTEX, 0);
    revision_ = mesh.revision;
    commit();
    return true;
}

void EmbreeMesh::commit() {
    if (geometry_) rtcCommitGeometry(geometry_.get());
    rtcCommitScene(scene_.get());
}

}  // namespace tarn
