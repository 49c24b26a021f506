// The table of lights: punctual ones first, then every emissive triangle, and the alias table by power.
#include <algorithm>
#include <cmath>
#include <utility>

#include "shared/math/light.h"
#include "world/alias_builder.h"
#include "world/build_steps.h"
#include "world/scene_access.h"

namespace tarn {
namespace {

// Lights are gathered with their weights, then packed.
struct LightList {
    std::vector<glm::uvec4> rows;
    std::vector<double> powers;
    std::vector<std::uint64_t> identities;
    std::vector<std::pair<std::uint32_t, EmissionMap>> maps;  // of the lights that have one

    std::uint32_t add(const Light& light, double power, std::uint64_t identity) {
        const std::size_t first = rows.size();
        rows.resize(first + LIGHT_ROWS);
        pack_light(light, rows[first], rows[first + 1], rows[first + 2], rows[first + 3]);
        powers.push_back(power);
        identities.push_back(identity);
        return std::uint32_t(powers.size() - 1);
    }

    // Appends the emission maps behind all lights and tells each light where its own begins.
    void append_maps() {
        for (const auto& [light, map] : maps) {
            const std::size_t first = rows.size();
            rows.resize(first + EMISSION_MAP_ROWS);
            pack_emission_map(map, rows[first], rows[first + 1], rows[first + 2]);
            rows[light * LIGHT_ROWS + 3].w = std::uint32_t(first) + EMISSION_MAP_TAG;
        }
    }
};

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

void add_punctual_lights(LightList& list, const World& world, const Scene& scene, const Pose& pose) {
    const double radius = world.bounds.empty() ? 1.0 : 0.5 * glm::length(world.bounds.extent());
    for (const NodeIndex node : scene.light_nodes) {
        const PunctualLight& source = at(scene.lights, at(scene.nodes, node).light);
        if (max_component(source.intensity) <= 0.0f) continue;
        list.add(make_punctual(source, at(pose.world_from_node, node), world.origin_ws),
                 punctual_power(source, radius), node.value);
    }
}

EmissionMap make_emission_map(SceneAccess& access, const InstanceRecord& instance, std::uint32_t primitive) {
    const SlotRecord slot = access.load_slot(instance.material, SLOT_EMISSION);
    const glm::uvec3 vertices = access.load_vertex_indices(instance, primitive);
    const auto uv_at = [&](std::uint32_t vertex) {
        const glm::vec2 second = access.unpack_uv1(access.fetch_vertex_row(vertex * VERTEX_ROWS + 3));
        return access.slot_uv(slot, access.load_uv0(vertex), second);
    };
    return {uv_at(vertices.x), uv_at(vertices.y), uv_at(vertices.z), slot.first_texel, slot.size, slot.flags};
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

Light make_triangle(const World& world, SceneAccess& access, std::uint32_t instance, std::uint32_t primitive,
                    const MaterialRecord& material, bool textured) {
    const InstanceRecord record = access.load_instance(instance);
    const glm::uvec3 vertices = access.load_vertex_indices(record, primitive);
    const glm::vec3 p0 = access.transform_point(record, access.load_position_os(vertices.x));
    const glm::vec3 p1 = access.transform_point(record, access.load_position_os(vertices.y));
    const glm::vec3 p2 = access.transform_point(record, access.load_position_os(vertices.z));
    Light light{};
    light.flags = LIGHT_TRIANGLE;
    if ((material.flags & MATERIAL_DOUBLE_SIDED) != 0u) light.flags |= LIGHT_DOUBLE_SIDED;
    // The lit side of a mirrored triangle is the other one. Its vertices keep their order, for the
    // barycentrics' sake.
    if (world.instances[instance].mirrored) light.flags |= LIGHT_MIRRORED;
    if (textured) light.flags |= LIGHT_TEXTURED;
    if ((material.flags & (MATERIAL_ALPHA_MASK | MATERIAL_ALPHA_BLEND)) != 0u) light.flags |= LIGHT_COVERED;
    light.position = p0;
    light.edge1 = p1 - p0;
    light.edge2 = p2 - p0;
    light.instance = instance;
    light.primitive = primitive;
    light.radiance = material.emission;
    return light;
}

void add_triangle_lights(LightList& list, World& world) {
    SceneAccess access(world);
    WorldLights& lights = world.lights;
    for (std::uint32_t i = 0; i < world.instances.size(); ++i) {
        const std::uint32_t material_index = world.material_of(i);
        const MaterialRecord material = access.load_material(material_index);
        if (max_component(material.emission) <= 0.0f || (material.flags & MATERIAL_UNLIT) != 0u) continue;
        const bool textured = (access.load_slot(material_index, SLOT_EMISSION).flags & SLOT_PRESENT) != 0u;
        const double sides = (material.flags & MATERIAL_DOUBLE_SIDED) != 0u ? 2.0 : 1.0;
        lights.instance_first[i] = std::uint32_t(lights.light_of_primitive.size());
        const std::uint32_t count = world.meshes[world.instances[i].mesh].triangle_count;
        for (std::uint32_t primitive = 0; primitive < count; ++primitive) {
            const Light light = make_triangle(world, access, i, primitive, material, textured);
            const double area = triangle_area(light);
            std::uint32_t index = INVALID_INDEX;
            if (area > 0.0 && std::isfinite(area)) {
                double mean = luminance(light.radiance);
                if (textured) {
                    const EmissionMap map = make_emission_map(access, access.load_instance(i), primitive);
                    mean = mean_luminance(access, light, map);
                    list.maps.emplace_back(std::uint32_t(list.powers.size()), map);
                }
                const std::uint64_t source = world.instances[i].scene_instance + 1;
                index = list.add(light, sides * double(PI) * area * mean, source << 32 | primitive);
            }
            lights.light_of_primitive.push_back(index);
        }
    }
}

}  // namespace

void rebuild_lights(World& world, const Scene& scene, const Pose& pose) {
    WorldLights& lights = world.lights;
    const std::uint64_t revision = lights.revision + 1;
    lights = WorldLights{};
    lights.revision = revision;
    lights.structure_revision = revision;
    lights.instance_first.assign(world.instances.size(), INVALID_INDEX);
    LightList list;
    add_punctual_lights(list, world, scene, pose);
    lights.punctual_count = std::uint32_t(list.powers.size());
    add_triangle_lights(list, world);
    lights.count = std::uint32_t(list.powers.size());
    list.append_maps();
    AliasTable table = build_alias_table(list.powers);
    lights.rows = std::move(list.rows);
    lights.alias_rows = std::move(table.rows);
    lights.pmf = std::move(table.pmf);
    lights.identities = std::move(list.identities);
    lights.last_changed = lights.count;
}

}  // namespace tarn
