// Robust ray origins: moved off a surface by the rounding error of the position, never by a fixed epsilon.
#pragma once

#include "shared/dialect.h"

SHARED_BEGIN

// Bound on the rounding error of a point that was interpolated on a triangle and transformed, metres.
// `largest_term` is the largest sum of the absolute terms of a coordinate: |M| |p| + |t|.
// 2^-24 per rounding; about 10 roundings here and as many in the tracer's own transform of the ray, doubled
// for safety. (Pharr, Jakob, Humphreys, "Physically Based Rendering", 4th ed., section 6.8.)
FN float position_error_bound(float largest_term) {
    return 48.0f * 5.9604645e-8f * largest_term;
}

// The origin of a ray that leaves `position` towards `direction`, on the side of the geometric normal that it
// leaves to. `error` is the bound per coordinate; the normal's L1 norm turns it into a distance along the
// normal.
FN vec3 offset_ray_origin(vec3 position, float error, vec3 geometric_normal, vec3 direction) {
    vec3 n = geometric_normal;
    float distance = error * (abs(n.x) + abs(n.y) + abs(n.z));
    float side = dot(n, direction) >= 0.0f ? 1.0f : -1.0f;
    return position + n * (distance * side);
}

SHARED_END
