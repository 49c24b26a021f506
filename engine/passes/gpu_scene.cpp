#include "passes/gpu_scene.h"

#include <span>

#include "shared/interface/bindings.h"

namespace tarn {
namespace {

template <class Item>
std::vector<std::uint64_t> revisions_of(const std::vector<Item>& items) {
    std::vector<std::uint64_t> revisions;
    for (const Item& item : items) revisions.push_back(item.revision);
    return revisions;
}

// Vertices of all meshes, then room for the last frame's of those that deform.
std::vector<glm::uvec4> vertex_rows_with_history(const World& world) {
    std::vector<glm::uvec4> rows = world.vertex_rows;
    for (const WorldMesh& mesh : world.meshes) {
        if (!mesh.deforms) continue;
        const auto first = world.vertex_rows.begin() + std::ptrdiff_t(mesh.first_vertex * VERTEX_ROWS);
        rows.insert(rows.end(), first, first + std::ptrdiff_t(mesh.vertex_count * VERTEX_ROWS));
    }
    return rows;
}

std::vector<std::uint32_t> find_previous_vertices(const World& world) {
    std::vector<std::uint32_t> result;
    std::size_t next = world.vertex_rows.size() / VERTEX_ROWS;
    for (const WorldMesh& mesh : world.meshes) {
        result.push_back(mesh.deforms ? std::uint32_t(next) : INVALID_INDEX);
        if (mesh.deforms) next += mesh.vertex_count;
    }
    return result;
}

// The instances as they are, with the vertices and the materials that the last frame had.
std::vector<glm::uvec4> previous_instance_rows(const World& world,
                                               const std::vector<std::uint32_t>& previous_first_vertex) {
    const auto material_count = std::uint32_t(world.material_flags.size());
    std::vector<glm::uvec4> rows = world.instance_rows;
    for (std::size_t i = 0; i < world.instances.size(); ++i) {
        glm::uvec4& row = rows[i * INSTANCE_ROWS + 3];
        const std::uint32_t first = previous_first_vertex[world.instances[i].mesh];
        if (first != INVALID_INDEX) row.y = first;
        row.z += material_count;
    }
    return rows;
}

std::vector<glm::uvec4> instance_rows_with_history(const World& world,
                                                   const std::vector<std::uint32_t>& previous_first_vertex) {
    std::vector<glm::uvec4> rows = world.instance_rows;
    const std::vector<glm::uvec4> previous = previous_instance_rows(world, previous_first_vertex);
    rows.insert(rows.end(), previous.begin(), previous.end());
    return rows;
}

std::vector<glm::uvec4> twice(const std::vector<glm::uvec4>& rows) {
    std::vector<glm::uvec4> result = rows;
    result.insert(result.end(), rows.begin(), rows.end());
    return result;
}

}  // namespace

GpuScene::GpuScene(const World& world)
    : mesh_revisions_(revisions_of(world.meshes)),
      instance_revisions_(revisions_of(world.instances)),
      material_revision_(world.material_revision),
      previous_first_vertex_(find_previous_vertices(world)),
      vertices_("scene/vertex_rows", vertex_rows_with_history(world), GL_RGBA32UI),
      triangles_("scene/triangles", world.triangles, GL_RGB32UI),
      instances_("scene/instance_rows", instance_rows_with_history(world, previous_first_vertex_),
                 GL_RGBA32UI),
      materials_("scene/material_rows", twice(world.material_rows), GL_RGBA32UI),
      texels_("scene/texels", world.texels, GL_RGBA16),
      lights_(world.lights),
      environment_texels_("scene/environment_texels", world.environment.texels, GL_RGBA32F),
      environment_alias_("scene/environment_alias", world.environment.alias_rows, GL_RGBA32UI) {}

void GpuScene::update(const World& world) {
    update_vertices(world);
    if (const auto revisions = revisions_of(world.instances); revisions != instance_revisions_) {
        instance_revisions_ = revisions;
        instances_.upload(world.instance_rows);
        moved_instances_ = true;
    }
    if (world.material_revision != material_revision_) {
        material_revision_ = world.material_revision;
        materials_.upload(world.material_rows);
        edited_materials_ = has_edited_materials_ = true;
    }
    has_moved_ = has_moved_ || moved_instances_ || !moved_meshes_.empty();
    lights_.update(world.lights);
}

void GpuScene::update_vertices(const World& world) {
    for (std::size_t i = 0; i < world.meshes.size(); ++i) {
        const WorldMesh& mesh = world.meshes[i];
        if (mesh.revision == mesh_revisions_[i]) continue;
        mesh_revisions_[i] = mesh.revision;
        moved_meshes_.push_back(std::uint32_t(i));
        const std::size_t first_row = std::size_t(mesh.first_vertex) * VERTEX_ROWS;
        const std::size_t row_count = std::size_t(mesh.vertex_count) * VERTEX_ROWS;
        vertices_.upload_range(first_row, std::span(world.vertex_rows).subspan(first_row, row_count));
    }
}

void GpuScene::advance(const World& world) {
    for (const std::uint32_t i : moved_meshes_) {
        const WorldMesh& mesh = world.meshes[i];
        const std::size_t row_count = std::size_t(mesh.vertex_count) * VERTEX_ROWS;
        vertices_.copy_rows(std::size_t(mesh.first_vertex) * VERTEX_ROWS,
                            std::size_t(previous_first_vertex_[i]) * VERTEX_ROWS, row_count);
    }
    moved_meshes_.clear();
    if (moved_instances_) {
        const std::vector<glm::uvec4> rows = previous_instance_rows(world, previous_first_vertex_);
        instances_.upload_range(world.instance_rows.size(), std::span<const glm::uvec4>(rows));
        moved_instances_ = false;
    }
    if (edited_materials_) {
        materials_.copy_rows(0, world.material_rows.size(), world.material_rows.size());
        edited_materials_ = false;
    }
    lights_.advance();
}

void GpuScene::bind(FrameRecorder& recorder) const {
    recorder.bind_table(UNIT_VERTEX_ROWS, vertices_.rows());
    recorder.bind_table(UNIT_TRIANGLES, triangles_.rows());
    recorder.bind_table(UNIT_INSTANCE_ROWS, instances_.rows());
    recorder.bind_table(UNIT_MATERIAL_ROWS, materials_.rows());
    recorder.bind_table(UNIT_TEXELS, texels_.rows());
    lights_.bind(recorder);
    recorder.bind_table(UNIT_ENVIRONMENT_TEXELS, environment_texels_.rows());
    recorder.bind_table(UNIT_ENVIRONMENT_ALIAS, environment_alias_.rows());
}

}  // namespace tarn
