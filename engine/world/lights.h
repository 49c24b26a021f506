// The table of lights: which there are, who they are from one moment to the next, and what has changed.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "world/change_log.h"

namespace tarn {

// The triangle lights of one instance, and the state of the instance from which they were written.
struct EmissiveInstance {
    std::uint32_t instance = 0;  // in World::instances
    IndexRange lights;           // in the order of its primitives; those without area are left out
    std::uint32_t flags = 0;     // LIGHT_*, of each of them
    glm::vec3 radiance{0.0f};
    std::uint64_t instance_revision = 0;
    std::uint64_t mesh_revision = 0;
    glm::mat3 scale{1.0f};  // products of its transform's axes when the powers were computed
};

// Lights keep their order: punctual ones as in Scene::light_nodes, then the emissive triangles by instance
// and primitive.
//
// What changed travels by `changes`, which each reader follows with a cursor of its own. Two revisions tell
// what it means: `order_revision` grows where lights came, went or changed places, so that indices mean
// something else; `structure_revision` with that, and where the alias table or an emission map changed. Where
// it has not grown, all that changed is in `changes`.
struct WorldLights {
    std::vector<glm::uvec4> rows;        // LIGHT_ROWS a light, then EMISSION_MAP_ROWS a textured one
    std::vector<glm::uvec4> alias_rows;  // by power
    std::vector<float> pmf;              // probability of each light under the alias table
    // Watts of luminance, from which the alias table is made; may lag behind what a deforming mesh emits by
    // POWER_TOLERANCE. A directional light's is what falls on the disc around World::bounds.
    std::vector<double> powers;
    // Who a light is, whatever its index: a punctual light is its node, a triangle its scene instance and
    // primitive. No two lights share one.
    std::vector<std::uint64_t> identities;
    std::uint32_t count = 0;
    std::uint32_t punctual_count = 0;          // these come first
    std::vector<std::uint32_t> light_of_node;  // the node's punctual light, or INVALID_INDEX
    // Triangle lights by where they are: instance_first[i] is the index into `light_of_primitive` of instance
    // i's first primitive, or INVALID_INDEX where the instance does not emit.
    std::vector<std::uint32_t> instance_first;
    std::vector<std::uint32_t> light_of_primitive;
    std::vector<EmissiveInstance> emissive_instances;  // in the order of their lights

    ChangeLog changes;  // of lights whose rows were written
    std::uint64_t order_revision = 0;
    std::uint64_t structure_revision = 0;
};

// Relative change of a light's power from which on the alias table follows it. Any table gives the same mean.
inline constexpr double POWER_TOLERANCE = 1e-3;

// Identities, as in WorldLights.
inline std::uint64_t identify_punctual(std::uint32_t node) {
    return (std::uint64_t(1) << 63) | node;
}
inline std::uint32_t node_of_punctual(std::uint64_t identity) {
    return std::uint32_t(identity);
}
inline std::uint64_t identify_triangle(std::uint32_t scene_instance, std::uint32_t primitive) {
    return (std::uint64_t(scene_instance) << 32) | primitive;
}

}  // namespace tarn
