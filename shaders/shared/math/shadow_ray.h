// The ray that asks whether a light sample reaches a point: both ends moved off their surfaces by the
// rounding error of their positions.
#pragma once

#include "shared/dialect.h"
#include "shared/interface/records.h"
#include "shared/math/light.h"
#include "shared/math/ray_offset.h"
#include "shared/math/shading.h"

SHARED_BEGIN

// The shadow ray from `p` to the sample `incident`, whose value must not be 0 (such a sample needs no ray).
// `light_error` bounds the rounding error of the sample's position on its light, metres (load_light_error in
// scene/lights.h; 0 for lights without a surface). Finite lights: direction = target - origin and max_t = 1;
// the sky and directional lights: unit direction and max_t = RAY_INFINITY. Two places that touch get an
// inactive ray.
FN RayRecord make_shadow_ray(ShadingPoint p, IncidentLight incident, float light_error, uint pixel) {
    RayRecord ray = inactive_ray();
    ray.pixel = pixel;
    ray.origin = offset_ray_origin(p.position, p.position_error, p.geometric_normal, incident.direction);
    if (incident.distance >= RAY_INFINITY) {
        ray.direction = incident.direction;
        ray.max_t = RAY_INFINITY;
        return ray;
    }
    // A punctual light may lie on a surface: its target moves back along the ray.
    bool has_surface = dot(incident.light_normal, incident.light_normal) > 0.0f;
    vec3 away = has_surface ? incident.light_normal : -incident.direction;
    // The target is found again from the point's position, so that its error counts here as well.
    vec3 target = offset_ray_origin(p.position + incident.direction * incident.distance,
                                    light_error + p.position_error, away, away);
    vec3 to_target = target - ray.origin;
    if (dot(to_target, incident.direction) <= 0.0f) return ray;
    ray.direction = to_target;
    ray.max_t = 1.0f;
    return ray;
}

SHARED_END
