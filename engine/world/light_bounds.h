// Where lights are, where they shine and how strongly: the bounds of a light and of groups of lights.
#pragma once

#include <glm/glm.hpp>

#include "shared/math/light.h"

namespace tarn {

// As LightTreeNode (shaders/shared/math/light_tree.h), exactly: a box instead of a sphere, angles instead of
// cosines.
struct LightBounds {
    glm::vec3 lower{1e30f};
    glm::vec3 upper{-1e30f};
    glm::vec3 axis{0.0f, 0.0f, 1.0f};
    float normals_rad = 0.0f;   // around the axis: the normals of all lights
    float emission_rad = 0.0f;  // around a normal: where its light goes
    float intensity = 0.0f;     // sum of what the lights send at most in one direction, luminance W/sr
    bool two_sided = false;

    glm::vec3 centre() const { return 0.5f * (lower + upper); }
};

// Bounds of a point, spot or triangle light of this power (WorldLights::powers).
LightBounds bound_light(const Light& light, double power);

// Bounds of both. The cone is the smallest one around both cones.
LightBounds unite(const LightBounds& a, const LightBounds& b);

// The solid angle into which lights may shine whose normals lie in a cone, those beyond it weighted by the
// cosine (Conty Estevez and Kulla 2018, equation 1).
float measure_orientation(float normals_rad, float emission_rad);

}  // namespace tarn
