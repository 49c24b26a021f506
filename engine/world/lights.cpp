// The table of lights from scratch: punctual ones first, then every emissive triangle, their emission maps
// behind them, and the alias table by power.
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <cmath>

#include "world/alias_builder.h"
#include "world/build_steps.h"
#include "world/light_sources.h"
#include "world/light_table.h"

namespace tarn {
namespace {

constexpr std::size_t GRAIN = 1024;  // triangles worth a task of their own

// Calls work(emitter, its first slot in light_of_primitive, primitive) for each emissive triangle, on all
// threads.
template <class Work>
void for_each_triangle(const WorldLights& lights, const std::vector<Emitter>& emitters, const Work& work) {
    tbb::parallel_for(std::size_t(0), emitters.size(), [&](std::size_t e) {
        const Emitter& emitter = emitters[e];
        const std::uint32_t first = lights.instance_first[emitter.instance];
        tbb::parallel_for(tbb::blocked_range<std::uint32_t>(0, emitter.triangle_count, GRAIN),
                          [&](const auto& range) {
                              for (auto p = range.begin(); p != range.end(); ++p) work(emitter, first, p);
                          });
    });
}

std::vector<Emitter> place_emitters(World& world) {
    WorldLights& lights = world.lights;
    lights.instance_first.assign(world.instances.size(), INVALID_INDEX);
    std::vector<Emitter> emitters;
    std::uint32_t slots = 0;
    for (std::uint32_t i = 0; i < world.instances.size(); ++i) {
        const std::optional<Emitter> emitter = find_emitter(world, i);
        if (!emitter) continue;
        lights.instance_first[i] = slots;
        slots += emitter->triangle_count;
        emitters.push_back(*emitter);
    }
    lights.light_of_primitive.assign(slots, INVALID_INDEX);
    return emitters;
}

// Gives each triangle with an area its index. `powers` holds one a slot, negative where there is no area.
void number_triangles(World& world, const std::vector<Emitter>& emitters, const std::vector<double>& powers) {
    WorldLights& lights = world.lights;
    for (const Emitter& emitter : emitters) {
        const std::uint32_t first = lights.instance_first[emitter.instance], start = lights.count;
        const std::uint32_t scene_instance = world.instances[emitter.instance].scene_instance;
        for (std::uint32_t primitive = 0; primitive < emitter.triangle_count; ++primitive) {
            if (powers[first + primitive] < 0.0) continue;
            lights.light_of_primitive[first + primitive] = lights.count++;
            lights.powers.push_back(powers[first + primitive]);
            lights.identities.push_back(identify_triangle(scene_instance, primitive));
        }
        lights.emissive_instances.push_back(record_emissive_instance(world, emitter, {start, lights.count}));
    }
}

void add_triangle_lights(World& world) {
    WorldLights& lights = world.lights;
    const std::vector<Emitter> emitters = place_emitters(world);
    std::vector<double> powers(lights.light_of_primitive.size());
    SceneAccess access(world);
    for_each_triangle(lights, emitters, [&](const Emitter& emitter, std::uint32_t first, std::uint32_t p) {
        const Light light = make_triangle_light(access, emitter, p);
        powers[first + p] = has_area(light) ? compute_triangle_power(access, emitter, light) : -1.0;
    });
    number_triangles(world, emitters, powers);
    lights.rows.resize(std::size_t(lights.count) * LIGHT_ROWS);
    for_each_triangle(lights, emitters, [&](const Emitter& emitter, std::uint32_t first, std::uint32_t p) {
        const std::uint32_t index = lights.light_of_primitive[first + p];
        if (index != INVALID_INDEX) write_light(lights, index, make_triangle_light(access, emitter, p));
    });
}

void add_punctual_lights(WorldLights& lights, const std::vector<PunctualSource>& sources,
                         std::size_t node_count) {
    lights.rows.resize(sources.size() * LIGHT_ROWS);
    lights.light_of_node.assign(node_count, INVALID_INDEX);
    for (const PunctualSource& source : sources) {
        lights.light_of_node[node_of_punctual(source.identity)] = lights.count;
        write_light(lights, lights.count++, source.light);
        lights.powers.push_back(source.power);
        lights.identities.push_back(source.identity);
    }
    lights.punctual_count = lights.count;
}

// Appends the emission maps behind all lights and tells each light where its own begins.
void append_emission_maps(World& world) {
    WorldLights& lights = world.lights;
    SceneAccess access(world);
    for (const EmissiveInstance& source : lights.emissive_instances) {
        if ((source.flags & LIGHT_TEXTURED) == 0u) continue;
        const std::optional<Emitter> emitter = find_emitter(world, source.instance);
        for (std::uint32_t light = source.lights.first; light < source.lights.last; ++light) {
            const std::uint32_t primitive = lights.rows[light * LIGHT_ROWS + 2].w;
            const EmissionMap map = make_emission_map(access, *emitter, primitive);
            const std::size_t first = lights.rows.size();
            lights.rows.resize(first + EMISSION_MAP_ROWS);
            pack_emission_map(map, lights.rows[first], lights.rows[first + 1], lights.rows[first + 2]);
            lights.rows[light * LIGHT_ROWS + 3].w = std::uint32_t(first) + EMISSION_MAP_TAG;
        }
    }
}

}  // namespace

EmissiveInstance record_emissive_instance(const World& world, const Emitter& emitter,
                                          const IndexRange& lights) {
    const WorldInstance& instance = world.instances[emitter.instance];
    EmissiveInstance record;
    record.instance = emitter.instance;
    record.lights = lights;
    record.flags = emitter.flags;
    record.radiance = emitter.radiance;
    record.instance_revision = instance.revision;
    record.mesh_revision = world.meshes[instance.mesh].revision;
    record.scale = measure_scale(instance.world_from_object);
    return record;
}

glm::mat3 measure_scale(const glm::mat4& world_from_object) {
    const glm::dmat3 axes(world_from_object);
    return glm::mat3(glm::transpose(axes) * axes);
}

void rebuild_alias_table(WorldLights& lights) {
    AliasTable table = build_alias_table(lights.powers);
    lights.alias_rows = std::move(table.rows);
    lights.pmf = std::move(table.pmf);
}

void rebuild_lights(World& world, const Scene& scene, const Pose& pose) {
    const std::uint64_t order = world.lights.order_revision, structure = world.lights.structure_revision;
    ChangeLog changes = std::move(world.lights.changes);
    WorldLights& lights = world.lights = WorldLights{};
    add_punctual_lights(lights, list_punctual_lights(world, scene, pose), scene.nodes.size());
    add_triangle_lights(world);
    append_emission_maps(world);
    rebuild_alias_table(lights);
    lights.order_revision = order + 1;
    lights.structure_revision = structure + 1;
    lights.changes = std::move(changes);
    lights.changes.append_everything();
}

}  // namespace tarn
