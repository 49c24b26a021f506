// What a scene has, and so what shaders must know of: what it lacks is compiled out and costs nothing.
#pragma once

#include <string>
#include <vector>

#include "world/world.h"

namespace tarn {

// Defines of a shader variant, "NAME" or "NAME=VALUE".
using Defines = std::vector<std::string>;

// What may differ from the last frame: shaders that look back tell the two frames apart only where they must.
struct ChangeHistory {
    bool surfaces_move = false;
    bool lights_change = false;

    bool operator==(const ChangeHistory&) const = default;
};

struct SceneFeatures {
    bool lambert_only = false;  // no material has a specular layer
    bool textures = false;
    bool normal_maps = false;
    bool environment = false;
    bool punctual_lights = false;
    bool triangle_lights = false;
    bool textured_lights = false;
    bool covered_lights = false;  // emissive triangles of partial coverage
    bool motion = false;          // surfaces move or deform
    bool light_history = false;   // lights move or change

    bool operator==(const SceneFeatures&) const = default;

    Defines defines() const;
    // Every set of features that a still scene can have, and one that has and does everything.
    static std::vector<SceneFeatures> all();
};

// Why the scene's shaders are what they are: "TARN_TEXTURES", "7 texture slots in use".
struct FeatureReason {
    std::string define;
    std::string reason;
};

struct FeatureSurvey {
    SceneFeatures features;
    std::vector<FeatureReason> reasons;
    std::uint64_t triangles = 0;  // of all instances
    bool partly_covered = false;  // some surface has an alpha test
};

FeatureSurvey survey_features(const World& world, const ChangeHistory& history = {});

}  // namespace tarn
