// Lights that follow the scene: only what moved, dimmed or was edited is written again.
#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <cmath>

#include "world/build_steps.h"
#include "world/light_table.h"

namespace tarn {
namespace {

// Turning an instance changes the products of its axes by their rounding, about 1e-6.
constexpr float SCALE_TOLERANCE = 1e-5f;

bool is_same_scale(const glm::mat3& a, const glm::mat3& b) {
    float largest = 0.0f, difference = 0.0f;
    for (int column = 0; column < 3; ++column) {
        largest = std::max(largest, max_component(glm::abs(a[column])));
        difference = std::max(difference, max_component(glm::abs(a[column] - b[column])));
    }
    return difference <= SCALE_TOLERANCE * largest;
}

// Takes over the power where it is another one; says whether it did.
bool follow_power(double& power, double now) {
    if (std::abs(now - power) <= POWER_TOLERANCE * power) return false;
    power = now;
    return true;
}

// What an update has found so far. Threads add to it.
struct Findings {
    std::atomic<bool> order_changed = false;
    std::atomic<bool> powers_changed = false;
    std::vector<IndexRange> changed;  // one for each part of the table that was looked at
};

// Writes light `index` if it differs, and adds it to `range`.
void write_if_changed(WorldLights& lights, std::uint32_t index, const Light& light, IndexRange& range) {
    const glm::uvec4* rows = &lights.rows[std::size_t(index) * LIGHT_ROWS];
    const glm::uvec4 before[LIGHT_ROWS] = {rows[0], rows[1], rows[2], rows[3]};
    write_light(lights, index, light);
    if (std::equal(before, before + LIGHT_ROWS, rows)) return;
    if (range.first == range.last) range.first = index;
    range.last = index + 1;
}

bool is_same_order(const WorldLights& lights, const std::vector<PunctualSource>& sources) {
    if (sources.size() != lights.punctual_count) return false;
    for (std::size_t i = 0; i < sources.size(); ++i) {
        if (sources[i].identity != lights.identities[i]) return false;
    }
    return true;
}

void update_punctual_lights(WorldLights& lights, const std::vector<PunctualSource>& sources,
                            Findings& findings) {
    for (std::uint32_t i = 0; i < sources.size(); ++i) {
        IndexRange range;
        write_if_changed(lights, i, sources[i].light, range);
        if (range.last == 0) continue;
        findings.changed.push_back(range);
        if (follow_power(lights.powers[i], sources[i].power)) findings.powers_changed = true;
    }
}

// Whether the same instances emit as when the table was built.
bool is_same_emitters(const World& world) {
    std::size_t next = 0;
    const std::vector<EmissiveInstance>& known = world.lights.emissive_instances;
    for (std::uint32_t i = 0; i < world.instances.size(); ++i) {
        const std::optional<Emitter> emitter = find_emitter(world, i);
        if (!emitter) continue;
        if (next == known.size() || known[next].instance != i) return false;
        ++next;
    }
    return next == known.size();
}

// Writes the lights of one instance where it is now. `measure`: their powers, and which of them have an area,
// may have changed too.
IndexRange rewrite_instance(World& world, const Emitter& emitter, bool measure, Findings& findings) {
    WorldLights& lights = world.lights;
    SceneAccess access(world);
    IndexRange range;
    const std::uint32_t first = lights.instance_first[emitter.instance];
    for (std::uint32_t primitive = 0; primitive < emitter.triangle_count; ++primitive) {
        const std::uint32_t index = lights.light_of_primitive[first + primitive];
        if (index == INVALID_INDEX && !measure) continue;
        const Light light = make_triangle_light(access, emitter, primitive);
        if (measure && has_area(light) != (index != INVALID_INDEX)) findings.order_changed = true;
        if (index == INVALID_INDEX) continue;
        write_if_changed(lights, index, light, range);
        if (measure && follow_power(lights.powers[index], compute_triangle_power(access, emitter, light))) {
            findings.powers_changed = true;
        }
    }
    return range;
}

bool is_same_emission(const EmissiveInstance& a, const EmissiveInstance& b) {
    return a.flags == b.flags && a.radiance == b.radiance;
}

IndexRange update_instance(World& world, EmissiveInstance& source, Findings& findings) {
    const std::optional<Emitter> emitter = find_emitter(world, source.instance);
    EmissiveInstance now = record_emissive_instance(world, *emitter, source.lights);
    const bool measure = !is_same_emission(now, source) || now.mesh_revision != source.mesh_revision ||
                         !is_same_scale(now.scale, source.scale);
    // Where nothing was measured the powers are still those of the older scale.
    if (!measure) now.scale = source.scale;
    source = now;
    return rewrite_instance(world, *emitter, measure, findings);
}

void update_triangle_lights(World& world, bool edited, Findings& findings) {
    std::vector<EmissiveInstance*> stale;
    for (EmissiveInstance& source : world.lights.emissive_instances) {
        const WorldInstance& instance = world.instances[source.instance];
        const bool moved = instance.revision != source.instance_revision ||
                           world.meshes[instance.mesh].revision != source.mesh_revision;
        const bool changed =
            edited &&
            !is_same_emission(source, record_emissive_instance(world, *find_emitter(world, source.instance),
                                                               source.lights));
        if (moved || changed) stale.push_back(&source);
    }
    const std::size_t first = findings.changed.size();
    findings.changed.resize(first + stale.size());
    tbb::parallel_for(std::size_t(0), stale.size(), [&](std::size_t i) {
        findings.changed[first + i] = update_instance(world, *stale[i], findings);
    });
}

// Takes over what was found; all anew where lights came or went.
void finish_update(World& world, const Scene& scene, const Pose& pose, Findings& findings) {
    WorldLights& lights = world.lights;
    if (findings.order_changed) {
        rebuild_lights(world, scene, pose);
        return;
    }
    if (findings.powers_changed) {
        rebuild_alias_table(lights);
        ++lights.structure_revision;
    }
    std::vector<IndexRange> changed = merge_ranges(std::move(findings.changed));
    if (findings.powers_changed || !changed.empty()) lights.changes.append(std::move(changed));
}

// Lights of successive nodes make one range.
void move_punctual_lights(World& world, const Scene& scene, const LivePose& pose, Findings& findings) {
    WorldLights& lights = world.lights;
    IndexRange run;
    for (const NodeIndex node : pose.touched()) {
        const std::uint32_t index = at(lights.light_of_node, node);
        if (index == INVALID_INDEX) continue;
        IndexRange range;
        write_if_changed(lights, index, place_punctual_light(world, scene, pose.pose(), node), range);
        if (range.last == 0) continue;
        if (range.first == run.last) {
            run.last = range.last;
        } else {
            findings.changed.push_back(run);
            run = range;
        }
    }
    findings.changed.push_back(run);
}

}  // namespace

void update_lights(World& world, const Scene& scene, const Pose& pose) {
    WorldLights& lights = world.lights;
    const std::vector<PunctualSource> punctual = list_punctual_lights(world, scene, pose);
    if (!is_same_order(lights, punctual) || !is_same_emitters(world)) {
        rebuild_lights(world, scene, pose);
        return;
    }
    Findings findings;
    update_punctual_lights(lights, punctual, findings);
    update_triangle_lights(world, true, findings);
    finish_update(world, scene, pose, findings);
}

void move_lights(World& world, const Scene& scene, const LivePose& pose) {
    Findings findings;
    move_punctual_lights(world, scene, pose, findings);
    update_triangle_lights(world, false, findings);
    finish_update(world, scene, pose.pose(), findings);
}

}  // namespace tarn
