#include "plan/frame_plan.h"

#include "core/error.h"
#include "shared/math/light.h"

namespace tarn {
namespace {

// Materials that have a texture in `slot`.
std::size_t count_slot(const World& world, std::uint32_t slot) {
    std::size_t count = 0;
    for (std::size_t m = 0; m < world.material_flags.size(); ++m) {
        const std::size_t row = m * MATERIAL_ROWS + 4 + 2 * slot;
        if ((world.material_rows[row].z & SLOT_PRESENT) != 0u) ++count;
    }
    return count;
}

// Materials with a specular layer: a metal, or a dielectric whose F90 is not 0.
std::size_t count_specular(const World& world) {
    std::size_t count = 0;
    for (std::size_t m = 0; m < world.material_flags.size(); ++m) {
        const glm::uvec4* rows = &world.material_rows[m * MATERIAL_ROWS];
        const MaterialRecord record = unpack_material(rows[0], rows[1], rows[2], rows[3]);
        if (record.metallic > 0.0f || record.dielectric_f90 > 0.0f) ++count;
    }
    return count;
}

std::size_t count_lights_with(const WorldLights& lights, std::uint32_t flag) {
    std::size_t count = 0;
    for (std::size_t i = 0; i < lights.count; ++i) {
        if ((lights.rows[i * LIGHT_ROWS].w & flag) != 0u) ++count;
    }
    return count;
}

}  // namespace

std::vector<std::string> FramePlan::defines() const {
    std::vector<std::string> result;
    for (const PlanEntry& entry : entries) result.push_back(entry.define);
    return result;
}

FramePlan make_plan(const World& world, const PlanHistory& history) {
    FramePlan plan;
    const auto add = [&](const char* define, std::size_t count, const char* what) {
        if (count > 0) plan.entries.push_back({define, fmt::format("{} {}", count, what)});
    };
    std::size_t textures = 0;
    for (const std::uint32_t slot : {SLOT_BASE_COLOR, SLOT_METALLIC_ROUGHNESS, SLOT_NORMAL, SLOT_EMISSION}) {
        textures += count_slot(world, slot);
    }
    if (count_specular(world) == 0)
        plan.entries.push_back({"TARN_LAMBERT_ONLY", "no material has a specular layer"});
    const WorldLights& lights = world.lights;
    add("TARN_TEXTURES", textures, "texture slots in use");
    add("TARN_NORMAL_MAPS", count_slot(world, SLOT_NORMAL), "materials with a normal map");
    add("TARN_ENVIRONMENT", std::size_t(world.environment.width) * world.environment.height, "texels of sky");
    add("TARN_PUNCTUAL_LIGHTS", lights.punctual_count, "punctual lights");
    add("TARN_TRIANGLE_LIGHTS", lights.count - lights.punctual_count, "emissive triangles");
    add("TARN_TEXTURED_LIGHTS", count_lights_with(lights, LIGHT_TEXTURED),
        "emissive triangles with a texture");
    add("TARN_COVERED_LIGHTS", count_lights_with(lights, LIGHT_COVERED),
        "emissive triangles of partial coverage");
    if (history.surfaces_move) plan.entries.push_back({"TARN_MOTION", "surfaces move or deform"});
    if (history.lights_change) plan.entries.push_back({"TARN_LIGHT_HISTORY", "lights move or change"});
    return plan;
}

}  // namespace tarn
