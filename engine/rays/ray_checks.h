// Checks of rays and hits that all tracers share, so that Embree and the oracle cannot differ in them.
#pragma once

#include "rays/ray_tracer.h"
#include "world/scene_access.h"

namespace tarn {

enum class RayState { INACTIVE, TRACEABLE, REJECTED };

// Embree takes the reciprocal and the square of directions: shorter and longer ones than these leave float's
// range.
inline constexpr float MIN_DIRECTION = 1e-18f;
inline constexpr float MAX_DIRECTION = 1e18f;

// INACTIVE: max_t < 0. REJECTED: something is not finite, or the direction's largest component is out of
// range.
inline RayState classify_ray(const RayRecord& ray) {
    if (ray.max_t < 0.0f) return RayState::INACTIVE;
    const float largest = max_component(glm::abs(ray.direction));
    const bool finite = is_finite3(ray.origin) && is_finite3(ray.direction) && is_finite(ray.max_t);
    const bool directed = largest >= MIN_DIRECTION && largest <= MAX_DIRECTION;
    return finite && directed ? RayState::TRACEABLE : RayState::REJECTED;
}

// Whether a ray of `pixel` meets the surface there, or passes through its alpha. `material_rows`: those of
// the moment that the ray belongs to.
inline bool is_hit_covered(const World& world, std::span<const glm::uvec4> material_rows,
                           const CoverageKey& key, std::uint32_t pixel, std::uint32_t instance,
                           std::uint32_t primitive, const glm::vec2& barycentrics) {
    if (!world.has_alpha_test(instance)) return true;
    SceneAccess access(world, material_rows);
    const MaterialRecord material = access.load_material(world.material_of(instance));
    const float opacity = access.load_opacity(instance, primitive, barycentrics);
    const float u = random_coverage(RandomKey{pixel, key.frame, key.seed}, key.ray, instance, primitive);
    return access.is_covered(world.flags_of(instance), material.alpha_cutoff, opacity, u);
}

}  // namespace tarn
