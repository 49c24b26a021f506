// The world as the shared scene functions see it on the CPU: shaders/shared/scene/*.h become members of this
// class.
#pragma once

#include "shared/interface/records.h"
#include "shared/math/alias_table.h"
#include "shared/math/environment.h"
#include "shared/math/light_sample.h"
#include "shared/math/light_tree.h"
#include "shared/math/random.h"
#include "shared/math/ray_offset.h"
#include "shared/math/shading.h"
#include "shared/math/spherical_triangle.h"
#include "shared/math/texture_filter.h"
#include "shared/math/warp.h"
#include "world/light_tree.h"
#include "world/world.h"

namespace tarn {

// A view: keeps references to the world and the tree, which must outlive it. Safe to use from many threads.
class SceneAccess {
  public:
    explicit SceneAccess(const World& world) : SceneAccess(world, world.material_rows) {}
    // With materials of another moment.
    SceneAccess(const World& world, std::span<const uvec4> material_rows)
        : world_(world), material_rows_(material_rows) {}
    // With a tree over the world's lights; without one there is nothing to draw by it.
    SceneAccess(const World& world, const LightTree* light_tree) : SceneAccess(world) {
        light_tree_ = light_tree;
    }

    uvec4 fetch_vertex_row(uint row) const { return world_.vertex_rows[row]; }
    uvec3 fetch_triangle(uint triangle) const { return world_.triangles[triangle]; }
    uvec4 fetch_instance_row(uint row) const { return world_.instance_rows[row]; }
    uvec4 fetch_material_row(uint row) const { return material_rows_[row]; }
    vec4 fetch_texel(uint texel) const { return vec4(world_.texels[texel]) * (1.0f / 65535.0f); }
    uvec4 fetch_light_row(uint row) const { return world_.lights.rows[row]; }
    uvec4 fetch_light_alias_row(uint row) const { return world_.lights.alias_rows[row]; }
    uvec4 fetch_light_tree_row(uint row) const { return light_tree_->rows[row]; }
    uint get_light_tree_node_count() const { return light_tree_ != nullptr ? light_tree_->node_count : 0u; }
    uint fetch_light_slot(uint instance) const { return world_.lights.instance_first[instance]; }
    uint fetch_light_of_slot(uint slot) const { return world_.lights.light_of_primitive[slot]; }
    vec4 fetch_environment_texel(uint texel) const { return world_.environment.texels[texel]; }
    uvec4 fetch_environment_alias_row(uint row) const { return world_.environment.alias_rows[row]; }
    uint get_light_count() const { return world_.lights.count; }
    uvec2 get_environment_size() const { return uvec2(world_.environment.width, world_.environment.height); }

    // On the CPU nothing is compiled out.
    static constexpr bool SCENE_HAS_TEXTURES = true;
    static constexpr bool SCENE_HAS_NORMAL_MAPS = true;
    static constexpr bool SCENE_HAS_ENVIRONMENT = true;
    static constexpr bool SCENE_HAS_PUNCTUAL_LIGHTS = true;
    static constexpr bool SCENE_HAS_TRIANGLE_LIGHTS = true;
    static constexpr bool SCENE_HAS_TEXTURED_LIGHTS = true;
    static constexpr bool SCENE_HAS_COVERED_LIGHTS = true;

#include "shared/scene/lights.h"
#include "shared/scene/surface.h"
// These build on lights.h.
#include "shared/scene/light_hits.h"
#include "shared/scene/light_tree.h"

  private:
    const World& world_;
    std::span<const uvec4> material_rows_;
    const LightTree* light_tree_ = nullptr;
};

}  // namespace tarn
