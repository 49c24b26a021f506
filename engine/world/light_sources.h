// One light at a time: from nodes, instances and materials to the record of a light and its power.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "shared/math/light.h"
#include "world/scene_access.h"
#include "world/world.h"

namespace tarn {

struct PunctualSource {
    Light light;
    double power = 0.0;
    std::uint64_t identity = 0;
};

// The light of one node. Lights without intensity are none: see list_punctual_lights.
Light place_punctual_light(const World& world, const Scene& scene, const Pose& pose, NodeIndex node);

// The punctual lights that shine, in the order of Scene::light_nodes.
std::vector<PunctualSource> list_punctual_lights(const World& world, const Scene& scene, const Pose& pose);

// What the triangles of an emissive instance have in common.
struct Emitter {
    std::uint32_t instance = 0;
    std::uint32_t triangle_count = 0;
    std::uint32_t material = 0;
    std::uint32_t flags = 0;  // LIGHT_*, of each light
    glm::vec3 radiance{0.0f};
};

// The instance as an emitter; nullopt where it does not emit.
std::optional<Emitter> find_emitter(const World& world, std::uint32_t instance);

// A triangle of an emitter where it is now.
Light make_triangle_light(SceneAccess& access, const Emitter& emitter, std::uint32_t primitive);

// Whether a triangle light has an area to draw from.
bool has_area(const Light& light);

EmissionMap make_emission_map(SceneAccess& access, const Emitter& emitter, std::uint32_t primitive);

// Watts; the mean of the emission map is taken on a fixed grid of points.
double compute_triangle_power(SceneAccess& access, const Emitter& emitter, const Light& light);

}  // namespace tarn
