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

}  // namespace

GpuScene::GpuScene(const World& world)
    : mesh_revisions_(revisions_of(world.meshes)),
      instance_revisions_(revisions_of(world.instances)),
      vertices_("scene/vertex_rows", world.vertex_rows, GL_RGBA32UI),
      triangles_("scene/triangles", world.triangles, GL_RGB32UI),
      instances_("scene/instance_rows", world.instance_rows, GL_RGBA32UI),
      materials_("scene/material_rows", world.material_rows, GL_RGBA32UI),
      texels_("scene/texels", world.texels, GL_RGBA16),
      environment_texels_("scene/environment_texels", world.environment.texels, GL_RGBA32F),
      environment_alias_("scene/environment_alias", world.environment.alias_rows, GL_RGBA32UI) {
    upload_lights(world.lights);
}

void GpuScene::upload_lights(const WorldLights& lights) {
    light_revision_ = lights.revision;
    const std::size_t size_bytes = lights.rows.size() * sizeof(glm::uvec4);
    if (light_rows_ && light_rows_->holds(size_bytes) &&
        light_alias_->holds(lights.alias_rows.size() * sizeof(glm::uvec4))) {
        light_rows_->upload(lights.rows);
        light_alias_->upload(lights.alias_rows);
        return;
    }
    light_rows_.emplace("scene/light_rows", lights.rows, GL_RGBA32UI);
    light_alias_.emplace("scene/light_alias", lights.alias_rows, GL_RGBA32UI);
}

void GpuScene::update(const World& world) {
    for (std::size_t i = 0; i < world.meshes.size(); ++i) {
        const WorldMesh& mesh = world.meshes[i];
        if (mesh.revision == mesh_revisions_[i]) continue;
        mesh_revisions_[i] = mesh.revision;
        vertices_.upload_range(std::size_t(mesh.first_vertex) * VERTEX_ROWS,
                               std::span(world.vertex_rows)
                                   .subspan(std::size_t(mesh.first_vertex) * VERTEX_ROWS,
                                            std::size_t(mesh.vertex_count) * VERTEX_ROWS));
    }
    if (const auto revisions = revisions_of(world.instances); revisions != instance_revisions_) {
        instance_revisions_ = revisions;
        instances_.upload(world.instance_rows);
    }
    if (world.lights.revision != light_revision_) upload_lights(world.lights);
}

void GpuScene::bind() const {
    vertices_.bind(UNIT_VERTEX_ROWS);
    triangles_.bind(UNIT_TRIANGLES);
    instances_.bind(UNIT_INSTANCE_ROWS);
    materials_.bind(UNIT_MATERIAL_ROWS);
    texels_.bind(UNIT_TEXELS);
    light_rows_->bind(UNIT_LIGHT_ROWS);
    light_alias_->bind(UNIT_LIGHT_ALIAS);
    environment_texels_.bind(UNIT_ENVIRONMENT_TEXELS);
    environment_alias_.bind(UNIT_ENVIRONMENT_ALIAS);
}

}  // namespace tarn
