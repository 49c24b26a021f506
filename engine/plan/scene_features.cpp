#include "plan/scene_features.h"

#include <fmt/format.h>

#include "shared/math/light.h"

namespace tarn {
namespace {

struct FeatureName {
    bool SceneFeatures::*has;
    const char* define;
};

constexpr FeatureName NAMES[] = {
    {&SceneFeatures::lambert_only, "TARN_LAMBERT_ONLY"},
    {&SceneFeatures::textures, "TARN_TEXTURES"},
    {&SceneFeatures::normal_maps, "TARN_NORMAL_MAPS"},
    {&SceneFeatures::environment, "TARN_ENVIRONMENT"},
    {&SceneFeatures::punctual_lights, "TARN_PUNCTUAL_LIGHTS"},
    {&SceneFeatures::triangle_lights, "TARN_TRIANGLE_LIGHTS"},
    {&SceneFeatures::textured_lights, "TARN_TEXTURED_LIGHTS"},
    {&SceneFeatures::covered_lights, "TARN_COVERED_LIGHTS"},
    {&SceneFeatures::motion, "TARN_MOTION"},
    {&SceneFeatures::light_history, "TARN_LIGHT_HISTORY"},
};

const char* define_of(bool SceneFeatures::*feature) {
    for (const FeatureName& name : NAMES) {
        if (name.has == feature) return name.define;
    }
    return "";
}

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

Defines SceneFeatures::defines() const {
    Defines result;
    for (const FeatureName& name : NAMES) {
        if (this->*name.has) result.emplace_back(name.define);
    }
    return result;
}

// Some features imply others: a normal map is a texture, a textured light is a triangle with a texture.
std::vector<SceneFeatures> SceneFeatures::all() {
    std::vector<SceneFeatures> result;
    for (int bits = 0; bits < 1 << 5; ++bits) {
        SceneFeatures f;
        f.textures = (bits & 1) != 0;
        f.normal_maps = (bits & 2) != 0;
        f.environment = (bits & 4) != 0;
        f.punctual_lights = (bits & 8) != 0;
        f.triangle_lights = (bits & 16) != 0;
        if (f.normal_maps && !f.textures) continue;
        result.push_back(f);
        if (f.triangle_lights && f.textures) {
            result.push_back(f);
            result.back().textured_lights = true;
        }
        // These two change what the others have in common: once each is enough.
        if (f.triangle_lights) {
            result.push_back(f);
            result.back().covered_lights = true;
        } else {
            result.push_back(f);
            result.back().lambert_only = true;
        }
    }
    SceneFeatures everything;
    for (const FeatureName& name : NAMES) everything.*name.has = true;
    everything.lambert_only = false;
    result.push_back(everything);
    return result;
}

FeatureSurvey survey_features(const World& world, const ChangeHistory& history) {
    FeatureSurvey survey;
    const auto note = [&](bool SceneFeatures::*feature, bool has, const std::string& reason) {
        survey.features.*feature = has;
        if (has) survey.reasons.push_back({define_of(feature), reason});
    };
    const auto note_count = [&](bool SceneFeatures::*feature, std::size_t count, const char* what) {
        note(feature, count > 0, fmt::format("{} {}", count, what));
    };
    std::size_t textures = 0;
    for (const std::uint32_t slot : {SLOT_BASE_COLOR, SLOT_METALLIC_ROUGHNESS, SLOT_NORMAL, SLOT_EMISSION}) {
        textures += count_slot(world, slot);
    }
    using F = SceneFeatures;
    const WorldLights& lights = world.lights;
    note(&F::lambert_only, count_specular(world) == 0, "no material has a specular layer");
    note_count(&F::textures, textures, "texture slots in use");
    note_count(&F::normal_maps, count_slot(world, SLOT_NORMAL), "materials with a normal map");
    note_count(&F::environment, std::size_t(world.environment.width) * world.environment.height,
               "texels of sky");
    note_count(&F::punctual_lights, lights.punctual_count, "punctual lights");
    note_count(&F::triangle_lights, lights.count - lights.punctual_count, "emissive triangles");
    note_count(&F::textured_lights, count_lights_with(lights, LIGHT_TEXTURED),
               "emissive triangles with a texture");
    note_count(&F::covered_lights, count_lights_with(lights, LIGHT_COVERED),
               "emissive triangles of partial coverage");
    note(&F::motion, history.surfaces_move, "surfaces move or deform");
    note(&F::light_history, history.lights_change, "lights move or change");
    for (std::uint32_t i = 0; i < world.instances.size(); ++i) {
        survey.triangles += world.meshes[world.instances[i].mesh].triangle_count;
        survey.partly_covered = survey.partly_covered || world.has_alpha_test(i);
    }
    return survey;
}

}  // namespace tarn
