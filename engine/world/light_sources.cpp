#include "world/light_sources.h"

#include <algorithm>
#include <cmath>

#include "shared/math/colour.h"

namespace tarn {
namespace {

Light make_punctual(const PunctualLight& source, const glm::dmat4& world_from_node,
                    const glm::dvec3& origin_ws) {
    Light light{};
    light.flags = std::uint32_t(source.kind);
    light.position = glm::vec3(glm::dvec3(world_from_node[3]) - origin_ws);
    light.radiance = source.intensity;
    light.range = float(source.range_m);
    light.instance = INVALID_INDEX;
    light.primitive = INVALID_INDEX;
    const glm::dvec3 backward = glm::dvec3(world_from_node[2]);
    const double length = glm::length(backward);
    light.edge1 = length > 0.0 ? glm::vec3(-backward / length) : glm::vec3(0.0f, 0.0f, -1.0f);
    if (source.kind == LightKind::SPOT) {
        const double inner = std::cos(source.inner_cone_rad), outer = std::cos(source.outer_cone_rad);
        const double scale = 1.0 / std::max(0.001, inner - outer);
        light.edge2 = glm::vec3(float(scale), float(-outer * scale), 0.0f);
    }
    return light;
}

// Watts. A directional light's power is what falls on the disc around the scene.
double punctual_power(const PunctualLight& light, double scene_radius) {
    const double intensity = luminance(light.intensity);
    switch (light.kind) {
        case LightKind::POINT:
            return 4.0 * double(PI) * intensity;
        case LightKind::SPOT:
            return double(PI) * intensity *
                   (2.0 - std::cos(light.inner_cone_rad) - std::cos(light.outer_cone_rad));
        case LightKind::DIRECTIONAL:
            return double(PI) * scene_radius * scene_radius * intensity;
    }
    return 0.0;
}

// Mean luminance of a textured triangle, by a fixed grid of points. Never 0 by accident: a texture that is
// dark at all grid points keeps a small share, so that its bright spots stay reachable.
double mean_luminance(SceneAccess& access, const Light& light, const EmissionMap& map) {
    constexpr int STEPS = 4;
    double sum = 0.0;
    int count = 0;
    for (int i = 0; i < STEPS; ++i) {
        for (int j = 0; i + j < STEPS; ++j) {
            const glm::vec2 barycentrics((float(i) + 1.0f / 3.0f) / STEPS, (float(j) + 1.0f / 3.0f) / STEPS);
            sum += luminance(light.radiance * access.sample_emission_map(map, barycentrics));
            ++count;
        }
    }
    return std::max(sum / count, 0.01 * luminance(light.radiance));
}

}  // namespace

Light place_punctual_light(const World& world, const Scene& scene, const Pose& pose, NodeIndex node) {
    return make_punctual(at(scene.lights, at(scene.nodes, node).light), at(pose.world_from_node, node),
                         world.origin_ws);
}

std::vector<PunctualSource> list_punctual_lights(const World& world, const Scene& scene, const Pose& pose) {
    const double radius = world.bounds.empty() ? 1.0 : 0.5 * glm::length(world.bounds.extent());
    std::vector<PunctualSource> sources;
    sources.reserve(scene.light_nodes.size());
    for (const NodeIndex node : scene.light_nodes) {
        const PunctualLight& light = at(scene.lights, at(scene.nodes, node).light);
        if (max_component(light.intensity) <= 0.0f) continue;
        sources.push_back({place_punctual_light(world, scene, pose, node), punctual_power(light, radius),
                           identify_punctual(node.value)});
    }
    return sources;
}

std::optional<Emitter> find_emitter(const World& world, std::uint32_t instance) {
    SceneAccess access(world);
    Emitter emitter;
    emitter.instance = instance;
    emitter.triangle_count = world.meshes[world.instances[instance].mesh].triangle_count;
    emitter.material = world.material_of(instance);
    const MaterialRecord material = access.load_material(emitter.material);
    if (max_component(material.emission) <= 0.0f || (material.flags & MATERIAL_UNLIT) != 0u) {
        return std::nullopt;
    }
    emitter.radiance = material.emission;
    emitter.flags = LIGHT_TRIANGLE;
    if ((material.flags & MATERIAL_DOUBLE_SIDED) != 0u) emitter.flags |= LIGHT_DOUBLE_SIDED;
    // The lit side of a mirrored triangle is the other one. Its vertices keep their order, for the
    // barycentrics' sake.
    if (world.instances[instance].mirrored) emitter.flags |= LIGHT_MIRRORED;
    if ((access.load_slot(emitter.material, SLOT_EMISSION).flags & SLOT_PRESENT) != 0u) {
        emitter.flags |= LIGHT_TEXTURED;
    }
    if ((material.flags & (MATERIAL_ALPHA_MASK | MATERIAL_ALPHA_BLEND)) != 0u) emitter.flags |= LIGHT_COVERED;
    return emitter;
}

Light make_triangle_light(SceneAccess& access, const Emitter& emitter, std::uint32_t primitive) {
    const InstanceRecord record = access.load_instance(emitter.instance);
    const glm::uvec3 vertices = access.load_vertex_indices(record, primitive);
    const glm::vec3 p0 = access.transform_point(record, access.load_position_os(vertices.x));
    const glm::vec3 p1 = access.transform_point(record, access.load_position_os(vertices.y));
    const glm::vec3 p2 = access.transform_point(record, access.load_position_os(vertices.z));
    Light light{};
    light.flags = emitter.flags;
    light.position_error = position_error_bound(access.largest_absolute_term(
        record, access.load_position_os(vertices.x), access.load_position_os(vertices.y),
        access.load_position_os(vertices.z)));
    light.position = p0;
    light.edge1 = p1 - p0;
    light.edge2 = p2 - p0;
    light.instance = emitter.instance;
    light.primitive = primitive;
    light.radiance = emitter.radiance;
    return light;
}

bool has_area(const Light& light) {
    const float area = triangle_area(light);
    return area > 0.0f && std::isfinite(area);
}

EmissionMap make_emission_map(SceneAccess& access, const Emitter& emitter, std::uint32_t primitive) {
    const SlotRecord slot = access.load_slot(emitter.material, SLOT_EMISSION);
    const glm::uvec3 vertices = access.load_vertex_indices(access.load_instance(emitter.instance), primitive);
    const auto uv_at = [&](std::uint32_t vertex) {
        const glm::vec2 second = access.unpack_uv1(access.fetch_vertex_row(vertex * VERTEX_ROWS + 3));
        return access.slot_uv(slot, access.load_uv0(vertex), second);
    };
    return {uv_at(vertices.x), uv_at(vertices.y), uv_at(vertices.z), slot.first_texel, slot.size, slot.flags};
}

double compute_triangle_power(SceneAccess& access, const Emitter& emitter, const Light& light) {
    const double sides = (emitter.flags & LIGHT_DOUBLE_SIDED) != 0u ? 2.0 : 1.0;
    const double area = triangle_area(light);
    double mean = luminance(light.radiance);
    if ((emitter.flags & LIGHT_TEXTURED) != 0u) {
        mean = mean_luminance(access, light, make_emission_map(access, emitter, light.primitive));
    }
    return sides * double(PI) * area * mean;
}

}  // namespace tarn
