// Meshes, clusters, instances and the vertices of what deforms.
#include <algorithm>

#include "core/error.h"
#include "world/build_steps.h"

namespace tarn {
namespace {

// Few enough that culling pays, many enough that draws stay cheap.
constexpr std::uint32_t CLUSTER_TRIANGLES = 256;

void write_vertex(std::span<glm::uvec4> rows, const Mesh& mesh, std::size_t v, const glm::vec3& position,
                  const glm::vec3& normal, const glm::vec4& tangent) {
    Vertex vertex;
    vertex.position_os = position;
    vertex.normal_os = normal;
    vertex.tangent_os = tangent;
    vertex.uv0 = mesh.uv0.empty() ? glm::vec2(0.0f) : mesh.uv0[v];
    vertex.uv1 = mesh.uv1.empty() ? glm::vec2(0.0f) : mesh.uv1[v];
    vertex.color = mesh.colors.empty() ? glm::vec4(1.0f) : mesh.colors[v];
    pack_vertex(vertex, rows[v * VERTEX_ROWS], rows[v * VERTEX_ROWS + 1], rows[v * VERTEX_ROWS + 2],
                rows[v * VERTEX_ROWS + 3]);
}

std::span<glm::uvec4> vertex_rows_of(World& world, const WorldMesh& mesh) {
    return std::span(world.vertex_rows)
        .subspan(std::size_t(mesh.first_vertex) * VERTEX_ROWS, std::size_t(mesh.vertex_count) * VERTEX_ROWS);
}

void find_cluster_bounds(const World& world, WorldMesh& mesh) {
    for (Cluster& cluster : mesh.clusters) {
        cluster.lower_os = glm::vec3(1e30f);
        cluster.upper_os = glm::vec3(-1e30f);
        for (std::uint32_t t = 0; t < cluster.triangle_count; ++t) {
            const glm::uvec3 triangle = world.triangles[mesh.first_triangle + cluster.first_triangle + t];
            for (int corner = 0; corner < 3; ++corner) {
                const std::size_t row = std::size_t(mesh.first_vertex + triangle[corner]) * VERTEX_ROWS;
                const glm::vec3 position = row_xyz(world.vertex_rows[row]);
                cluster.lower_os = glm::min(cluster.lower_os, position);
                cluster.upper_os = glm::max(cluster.upper_os, position);
            }
        }
    }
}

std::uint32_t add_mesh(World& world, const Mesh& mesh) {
    WorldMesh result;
    result.first_triangle = std::uint32_t(world.triangles.size());
    result.triangle_count = std::uint32_t(mesh.triangles.size());
    result.first_vertex = std::uint32_t(world.vertex_rows.size() / VERTEX_ROWS);
    result.vertex_count = std::uint32_t(mesh.positions_os.size());
    world.triangles.insert(world.triangles.end(), mesh.triangles.begin(), mesh.triangles.end());
    world.vertex_rows.resize(world.vertex_rows.size() + mesh.positions_os.size() * VERTEX_ROWS);
    const std::span<glm::uvec4> rows = vertex_rows_of(world, result);
    for (std::size_t v = 0; v < mesh.positions_os.size(); ++v) {
        const glm::vec4 tangent = mesh.tangents_os.empty() ? glm::vec4(0.0f) : mesh.tangents_os[v];
        write_vertex(rows, mesh, v, mesh.positions_os[v], mesh.normals_os[v], tangent);
    }
    for (std::uint32_t first = 0; first < result.triangle_count; first += CLUSTER_TRIANGLES) {
        Cluster cluster;
        cluster.first_triangle = first;
        cluster.triangle_count = std::min(CLUSTER_TRIANGLES, result.triangle_count - first);
        result.clusters.push_back(cluster);
    }
    find_cluster_bounds(world, result);
    world.meshes.push_back(std::move(result));
    return std::uint32_t(world.meshes.size() - 1);
}

bool deforms(const Scene& scene, const Instance& instance) {
    const Mesh& mesh = at(scene.meshes, instance.mesh);
    return !mesh.morph_targets.empty() || (instance.skin.is_set() && mesh.influence_sets > 0);
}

void write_instance_rows(World& world, std::uint32_t index, std::uint32_t material) {
    const WorldInstance& instance = world.instances[index];
    const WorldMesh& mesh = world.meshes[instance.mesh];
    const glm::mat4 rows = glm::transpose(instance.world_from_object);
    for (std::uint32_t row = 0; row < 3; ++row) {
        world.instance_rows[index * INSTANCE_ROWS + row] = pack_row4(rows[int(row)]);
    }
    world.instance_rows[index * INSTANCE_ROWS + 3] = glm::uvec4(
        mesh.first_triangle, mesh.first_vertex, material, instance.mirrored ? INSTANCE_MIRRORED : 0u);
}

void deform_instance(World& world, const Scene& scene, const WorldInstance& instance, const Pose& pose) {
    const Instance& source = scene.instances[instance.scene_instance];
    const Mesh& mesh = at(scene.meshes, source.mesh);
    const DeformedMesh deformed = deform_mesh(scene, source, pose, world.origin_ws);
    WorldMesh& target = world.meshes[instance.mesh];
    const std::span<glm::uvec4> rows = vertex_rows_of(world, target);
    for (std::size_t v = 0; v < deformed.positions_os.size(); ++v) {
        const glm::vec4 tangent = deformed.tangents_os.empty() ? glm::vec4(0.0f) : deformed.tangents_os[v];
        write_vertex(rows, mesh, v, deformed.positions_os[v], deformed.normals_os[v], tangent);
    }
    find_cluster_bounds(world, target);
    ++target.revision;
}

}  // namespace

void add_meshes(World& world, const Scene& scene) {
    std::vector<std::uint32_t> shared(scene.meshes.size(), INVALID_INDEX);
    for (std::size_t i = 0; i < scene.instances.size(); ++i) {
        const Instance& source = scene.instances[i];
        const Mesh& mesh = at(scene.meshes, source.mesh);
        if (mesh.triangles.empty()) continue;
        WorldInstance instance;
        instance.scene_instance = std::uint32_t(i);
        if (deforms(scene, source)) {
            instance.mesh = add_mesh(world, mesh);
            world.meshes.back().deforms = true;
        } else {
            std::uint32_t& index = shared[source.mesh.value];
            if (index == INVALID_INDEX) index = add_mesh(world, mesh);
            instance.mesh = index;
        }
        world.instances.push_back(instance);
    }
    world.instance_rows.resize(world.instances.size() * INSTANCE_ROWS);
}

void place_instances(World& world, const Scene& scene, const Pose& pose) {
    for (std::uint32_t i = 0; i < world.instances.size(); ++i) {
        WorldInstance& instance = world.instances[i];
        const Instance& source = scene.instances[instance.scene_instance];
        const glm::dmat4 transform = origin_from_object(scene, source, pose, world.origin_ws);
        const glm::mat4 moved(transform);
        if (instance.revision == 0 || moved != instance.world_from_object) {
            instance.world_from_object = moved;
            instance.mirrored = glm::determinant(glm::dmat3(transform)) < 0.0;
            ++instance.revision;
            write_instance_rows(world, i, at(scene.meshes, source.mesh).material.value);
        }
        if (deforms(scene, source)) deform_instance(world, scene, instance, pose);
    }
}

}  // namespace tarn
