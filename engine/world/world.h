// The world at one moment, flattened into the records that shaders, rays and the reference all read.
//
// Everything is relative to `origin_ws`, a point near the scene, so that single precision keeps its digits
// wherever the scene lies. Records and their packing: shaders/shared/interface/records.h and
// shaders/shared/math/light.h.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <vector>

#include "core/image.h"
#include "scene/live_pose.h"
#include "scene/scene.h"
#include "shared/interface/records.h"
#include "world/lights.h"

namespace tarn {

// A contiguous part of a mesh's triangles with its bounds, for culling. Primitive indices keep the mesh's
// order.
struct Cluster {
    std::uint32_t first_triangle = 0;  // within the mesh
    std::uint32_t triangle_count = 0;
    glm::vec3 lower_os{0.0f};
    glm::vec3 upper_os{0.0f};
};

// Geometry that instances share. A deforming instance has one of its own.
struct WorldMesh {
    std::uint32_t first_triangle = 0;  // in World::triangles
    std::uint32_t triangle_count = 0;
    std::uint32_t first_vertex = 0;  // in World::vertex_rows / VERTEX_ROWS; triangles count from here
    std::uint32_t vertex_count = 0;
    std::vector<Cluster> clusters;
    bool deforms = false;        // by skin or morph targets
    std::uint64_t revision = 0;  // grows when vertices move
};

struct WorldInstance {
    std::uint32_t mesh = 0;            // in World::meshes
    std::uint32_t scene_instance = 0;  // in Scene::instances
    glm::mat4 world_from_object{1.0f};
    bool mirrored = false;
    std::uint64_t revision = 0;  // grows when the instance moves
};

// An emissive sky. Radiance and sampling probability per texel; see shaders/shared/math/environment.h.
struct WorldEnvironment {
    std::uint32_t width = 0;  // 0: no sky
    std::uint32_t height = 0;
    std::vector<glm::vec4> texels;  // radiance, probability
    std::vector<glm::uvec4> alias_rows;
};

struct World {
    glm::dvec3 origin_ws{0.0};
    bool is_animated = false;
    Bounds bounds;  // relative to the origin; of the first moment
    std::vector<WorldMesh> meshes;
    std::vector<WorldInstance> instances;
    std::vector<glm::uvec4> vertex_rows;
    std::vector<glm::uvec3> triangles;
    std::vector<glm::uvec4> instance_rows;
    std::vector<glm::uvec4> material_rows;
    std::vector<std::uint32_t> material_flags;  // MATERIAL_*, one a material
    std::vector<glm::u16vec4> texels;
    WorldLights lights;
    WorldEnvironment environment;
    LivePose pose;                        // of the scene at the latest update
    std::uint64_t scene_revision = 0;     // Scene::revision that this world follows
    std::uint64_t moves_followed = 0;     // of Scene::moves
    std::uint64_t material_revision = 0;  // grows when material rows change

    std::uint32_t material_of(std::uint32_t instance) const {
        return instance_rows[instance * INSTANCE_ROWS + 3].z;
    }
    std::uint32_t flags_of(std::uint32_t instance) const { return material_flags[material_of(instance)]; }
    // Whether hits on its surface depend on its opacity.
    bool has_alpha_test(std::uint32_t instance) const {
        return (flags_of(instance) & (MATERIAL_ALPHA_MASK | MATERIAL_ALPHA_BLEND)) != 0u;
    }
};

struct WorldOptions {
    std::optional<Image> environment;  // equirectangular radiance, 3 channels; replaces the even sky
    double time_s = -1.0;              // < 0: the rest pose
};

// A sky of the same grey radiance everywhere, for WorldOptions::environment.
Image make_even_sky(float radiance);

// Flattens a scene. Scenes without any light and without an environment get an even sky of radiance 1.
World build_world(const Scene& scene, const WorldOptions& options = {});

// Moves what `time_s` moves: instance rows, deformed vertices, lights. Where Scene::revision has grown it
// also follows edits: of nodes' transforms, of lights and light_nodes, and of materials' factors; where only
// Scene::moves has, of those nodes and what hangs below them, at a cost that does not grow with the others.
// (Meshes, instances, texture slots and alpha modes are those of build_world, and so is the sky.) Only what
// changed is written, revisions grow where something may have changed, and WorldLights::changes says which
// lights. Without animations and edits nothing is looked at. `bounds` and `origin_ws` stay those of the first
// moment: they set the near plane, an orthographic camera's depth range and how often a directional light is
// drawn, none of which is wrong for what moves out of them by less than the scene's size.
void update_world(World& world, const Scene& scene, double time_s);

// The camera at `index` of the scene, in this pose; nullopt when there is no such camera. Throws Error where
// its node's transform leaves it no direction: an axis of length 0, or not finite.
std::optional<CameraRecord> scene_camera(const Scene& scene, const World& world, CameraIndex index,
                                         double aspect, double time_s);

// A camera that looks from `position_ws` to `target_ws` with a vertical field of view in degrees.
CameraRecord look_at(const World& world, const glm::dvec3& position_ws, const glm::dvec3& target_ws,
                     double vertical_fov_deg, double aspect);

// A view of the whole scene from a little above, for scenes without a camera.
CameraRecord default_camera(const World& world, double aspect);

}  // namespace tarn
