#include "world/light_bounds.h"

#include <algorithm>
#include <cmath>

#include "shared/math/colour.h"
#include "shared/math/light_tree.h"

namespace tarn {
namespace {

// What a union may lose to rounding, radians.
constexpr float ROUNDING_RAD = 1e-6f;

float angle_between(const glm::vec3& a, const glm::vec3& b) {
    return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b));
}

void bound_triangle(const Light& light, double power, LightBounds& bounds) {
    const glm::vec3 corners[] = {light.position, light.position + light.edge1, light.position + light.edge2};
    for (const glm::vec3& corner : corners) {
        bounds.lower = glm::min(bounds.lower, corner);
        bounds.upper = glm::max(bounds.upper, corner);
    }
    const glm::vec3 normal = normalize_or_up(glm::cross(light.edge1, light.edge2));
    bounds.axis = (light.flags & LIGHT_MIRRORED) != 0u ? -normal : normal;
    bounds.two_sided = (light.flags & LIGHT_DOUBLE_SIDED) != 0u;
    bounds.emission_rad = 0.5f * PI;
    bounds.intensity = float(power / (double(PI) * (bounds.two_sided ? 2.0 : 1.0)));
}

// The full intensity within the inner cone, falling to 0 at the outer one.
void bound_spot(const Light& light, LightBounds& bounds) {
    const float scale = light.edge2.x, offset = light.edge2.y;
    const float outer_rad = std::acos(std::clamp(-offset / scale, -1.0f, 1.0f));
    const float inner_rad = std::acos(std::clamp((1.0f - offset) / scale, -1.0f, 1.0f));
    bounds.axis = light.edge1;
    bounds.normals_rad = inner_rad;
    bounds.emission_rad = std::min(outer_rad - inner_rad, 0.5f * PI);
}

// Grows the cone of `a` until it holds that of `b`.
void widen_cone(LightBounds& a, const LightBounds& b) {
    const float between_rad = angle_between(a.axis, b.axis);
    if (std::min(between_rad + b.normals_rad, PI) <= a.normals_rad) return;
    const float normals_rad = 0.5f * (a.normals_rad + between_rad + b.normals_rad) + ROUNDING_RAD;
    const float sine = std::sin(between_rad);
    if (normals_rad >= PI || (sine < 1e-4f && between_rad > 1.0f)) {
        a.normals_rad = PI;
        return;
    }
    const float turn_rad = normals_rad - a.normals_rad;
    a.normals_rad = normals_rad;
    if (sine < 1e-4f) {
        a.normals_rad += turn_rad;  // the axes are the same: nowhere to turn to
        return;
    }
    a.axis = glm::normalize(a.axis * std::sin(between_rad - turn_rad) + b.axis * std::sin(turn_rad));
}

}  // namespace

LightBounds bound_light(const Light& light, double power) {
    LightBounds bounds;
    if ((light.flags & LIGHT_KIND_MASK) == LIGHT_TRIANGLE) {
        bound_triangle(light, power, bounds);
    } else {
        bounds.lower = bounds.upper = light.position;
        bounds.normals_rad = PI;
        bounds.emission_rad = 0.5f * PI;
        bounds.intensity = luminance(light.radiance);
        if ((light.flags & LIGHT_KIND_MASK) == LIGHT_SPOT) bound_spot(light, bounds);
    }
    bounds.intensity = std::max(bounds.intensity, LIGHT_TREE_LEAST_IMPORTANCE);
    return bounds;
}

LightBounds unite(const LightBounds& a, const LightBounds& b) {
    LightBounds both = a.normals_rad >= b.normals_rad ? a : b;
    widen_cone(both, a.normals_rad >= b.normals_rad ? b : a);
    both.lower = glm::min(a.lower, b.lower);
    both.upper = glm::max(a.upper, b.upper);
    both.emission_rad = std::max(a.emission_rad, b.emission_rad);
    both.intensity = a.intensity + b.intensity;
    both.two_sided = a.two_sided || b.two_sided;
    return both;
}

float measure_orientation(float normals_rad, float emission_rad) {
    const float reach_rad = std::min(normals_rad + emission_rad, PI);
    const float sine = std::sin(normals_rad), cosine = std::cos(normals_rad);
    return 2.0f * PI * (1.0f - cosine) +
           0.5f * PI *
               (2.0f * (reach_rad - normals_rad) * sine - std::cos(normals_rad - 2.0f * reach_rad) + cosine);
}

}  // namespace tarn
