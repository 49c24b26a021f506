#include "rays/embree_still_scene.h"

#include <algorithm>

namespace tarn {
namespace {

// Which of the instances that `takes` names fit.
std::vector<bool> choose(const World& world, std::vector<bool> takes) {
    std::vector<std::uint32_t> users(world.meshes.size(), 0);
    std::size_t triangles = 0;
    for (std::size_t i = 0; i < takes.size(); ++i) {
        const std::uint32_t mesh = world.instances[i].mesh;
        ++users[mesh];
        if (world.meshes[mesh].deforms) takes[i] = false;
        if (takes[i]) triangles += world.meshes[mesh].triangle_count;
    }
    if (triangles <= EmbreeStillScene::MAX_TRIANGLES) return takes;
    triangles = 0;
    for (std::size_t i = 0; i < takes.size(); ++i) {
        const std::uint32_t mesh = world.instances[i].mesh;
        const std::size_t sum = triangles + world.meshes[mesh].triangle_count;
        takes[i] = takes[i] && users[mesh] == 1 && sum <= EmbreeStillScene::MAX_TRIANGLES;
        if (takes[i]) triangles = sum;
    }
    return takes;
}

// Rounded once: the rasterizer and the rays must find the same places.
void write_positions(const World& world, const WorldInstance& instance, glm::vec3* positions) {
    const WorldMesh& mesh = world.meshes[instance.mesh];
    const glm::dmat4 transform(instance.world_from_object);
    for (std::uint32_t v = 0; v < mesh.vertex_count; ++v) {
        const std::size_t row = std::size_t(mesh.first_vertex + v) * VERTEX_ROWS;
        positions[v] = glm::vec3(transform * glm::dvec4(row_xyz(world.vertex_rows[row]), 1.0));
    }
}

// Memory of Embree's own, which outlives the world's; null where there is none left, of which Embree keeps an
// error.
template <class Element>
Element* new_buffer(RTCGeometry geometry, RTCBufferType type, RTCFormat format, std::size_t count) {
    return static_cast<Element*>(rtcSetNewGeometryBuffer(geometry, type, 0, format, sizeof(Element), count));
}

}  // namespace

EmbreeStillScene::EmbreeStillScene(RTCDevice device, const World& world, const std::vector<bool>& takes,
                                   const std::vector<bool>& is_filtered, RTCFilterFunctionN coverage_filter)
    : scene_(rtcNewScene(device)), revisions_(world.instances.size(), NOT_TAKEN) {
    rtcSetSceneFlags(scene_.get(), RTC_SCENE_FLAG_ROBUST | EMBREE_QUERY_FILTER);
    const std::vector<bool> chosen = choose(world, takes);
    for (std::uint32_t i = 0; i < world.instances.size(); ++i) {
        const std::uint32_t mesh = world.instances[i].mesh;
        if (!chosen[i] || world.meshes[mesh].triangle_count == 0) continue;
        add(device, world, i, is_filtered[mesh] ? coverage_filter : nullptr);
    }
    build_ = std::async(std::launch::async, [scene = scene_.get()] { rtcCommitScene(scene); });
}

EmbreeStillScene::~EmbreeStillScene() {
    scene();
}

RTCScene EmbreeStillScene::scene() const {
    if (build_.valid()) build_.wait();
    return scene_.get();
}

void EmbreeStillScene::add(RTCDevice device, const World& world, std::uint32_t index,
                           RTCFilterFunctionN filter) {
    const WorldInstance& instance = world.instances[index];
    const WorldMesh& mesh = world.meshes[instance.mesh];
    const EmbreeGeometry geometry(rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE));
    auto* triangles =
        new_buffer<glm::uvec3>(geometry.get(), RTC_BUFFER_TYPE_INDEX, RTC_FORMAT_UINT3, mesh.triangle_count);
    auto* positions =
        new_buffer<glm::vec3>(geometry.get(), RTC_BUFFER_TYPE_VERTEX, RTC_FORMAT_FLOAT3, mesh.vertex_count);
    if (triangles == nullptr || positions == nullptr) return;
    std::copy_n(&world.triangles[mesh.first_triangle], mesh.triangle_count, triangles);
    write_positions(world, instance, positions);
    rtcSetGeometryIntersectFilterFunction(geometry.get(), filter);
    rtcSetGeometryOccludedFilterFunction(geometry.get(), filter);
    // Any pointer but null, see EmbreeMesh::is_winding_turned.
    if (instance.mirrored) rtcSetGeometryUserData(geometry.get(), geometry.get());
    rtcCommitGeometry(geometry.get());
    rtcAttachGeometryByID(scene_.get(), geometry.get(), index);
    revisions_[index] = instance.revision;
}

}  // namespace tarn
