// Points of a triangle, evenly over the solid angle under which a place sees it. Drawn evenly over its area
// instead, a triangle that begins close to the place sends nearly all of its light by points that are nearly
// never drawn.
//
// Source: J. Arvo, "Stratified Sampling of Spherical Triangles", 1995.
#pragma once

#include "shared/dialect.h"
#include "shared/math/warp.h"

SHARED_BEGIN

struct SphericalTriangle {
    vec3 a;  // unit, towards the corners
    vec3 b;
    vec3 c;
    float alpha;        // angle at `a`, rad
    float solid_angle;  // sr; 0 for a triangle that is seen edge-on or touches the place
};

// The angle at `corner` between the great circles to `p` and `q`.
FN float corner_angle(vec3 corner, vec3 p, vec3 q) {
    vec3 to_p = cross(corner, p);
    vec3 to_q = cross(corner, q);
    float lengths = sqrt(dot(to_p, to_p) * dot(to_q, to_q));
    return lengths > 0.0f ? acos(clamp(dot(to_p, to_q) / lengths, -1.0f, 1.0f)) : 0.0f;
}

// Of a triangle whose corners lie at these offsets from the place.
FN SphericalTriangle make_spherical_triangle(vec3 to_a, vec3 to_b, vec3 to_c) {
    SphericalTriangle t;
    t.a = to_a;
    t.b = to_b;
    t.c = to_c;
    t.alpha = 0.0f;
    t.solid_angle = 0.0f;
    float lengths = dot(to_a, to_a) * dot(to_b, to_b) * dot(to_c, to_c);
    if (!(lengths > 0.0f) || !is_finite(lengths)) return t;
    t.a = normalize(to_a);
    t.b = normalize(to_b);
    t.c = normalize(to_c);
    t.alpha = corner_angle(t.a, t.b, t.c);
    t.solid_angle = max(t.alpha + corner_angle(t.b, t.c, t.a) + corner_angle(t.c, t.a, t.b) - PI, 0.0f);
    return t;
}

// The unit part of `v` that stands upright on the unit vector `axis`.
FN vec3 upright_part(vec3 v, vec3 axis) {
    vec3 part = v - axis * dot(v, axis);
    float part_length = length(part);
    return part_length > 0.0f ? part / part_length : vec3(0.0f);
}

// A unit direction into the triangle, evenly over its solid angle, which must not be 0. `u` in [0, 1)^2.
FN vec3 sample_spherical_triangle(SphericalTriangle t, vec2 u) {
    float angle = u.x * t.solid_angle - t.alpha;
    float s = sin(angle);
    float k = cos(angle);
    float sin_alpha = sin(t.alpha);
    float cos_alpha = cos(t.alpha);
    float p = k - cos_alpha;
    float q = s + sin_alpha * dot(t.a, t.b);
    float divisor = (q * s + p * k) * sin_alpha;
    // How far along the side from a to c the cut lies that parts off the share u.x of the triangle.
    float cosine = divisor != 0.0f ? clamp(((q * k - p * s) * cos_alpha - q) / divisor, -1.0f, 1.0f) : 1.0f;
    vec3 cut = t.a * cosine + upright_part(t.c, t.a) * sqrt(max(0.0f, 1.0f - cosine * cosine));
    float z = 1.0f - u.y * (1.0f - dot(cut, t.b));
    return t.b * z + upright_part(cut, t.b) * sqrt(max(0.0f, 1.0f - z * z));
}

// Where a ray from the place along `direction` meets the plane of the triangle `to_a`, `to_a` + `edge1`,
// `to_a` + `edge2` (offsets from the place): barycentrics, kept within the triangle.
FN vec2 find_barycentrics(vec3 direction, vec3 to_a, vec3 edge1, vec3 edge2) {
    vec3 h = cross(direction, edge2);
    float determinant = dot(edge1, h);
    if (determinant == 0.0f) return vec2(1.0f / 3.0f);
    float x = clamp(-dot(to_a, h) / determinant, 0.0f, 1.0f);
    float y = -dot(direction, cross(to_a, edge1)) / determinant;
    return vec2(x, clamp(y, 0.0f, 1.0f - x));
}

SHARED_END
