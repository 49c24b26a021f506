// The environment map: an equirectangular picture of the sky, +Y up, its top row at the zenith, u = 0.5
// towards -Z. Radiance is bilinear between texel centres; the sampling density is constant in solid angle
// over each texel.
#pragma once

#include "shared/dialect.h"

SHARED_BEGIN

// Direction -> uv in [0, 1]^2.
FN vec2 environment_uv(vec3 direction) {
    float u = atan(direction.x, -direction.z) * (0.5f * INV_PI) + 0.5f;
    // acos loses digits near the poles; the arc tangent does not.
    float horizontal = sqrt(direction.x * direction.x + direction.z * direction.z);
    float v = atan(horizontal, direction.y) * INV_PI;
    return vec2(u, v);
}

// Rows between `row` and the nearer pole. Angles are measured from there: cosines near 1 would leave the
// first rows of a large map a handful of distinct heights, and sines of angles near pi lose digits too.
FN uint environment_rows_from_pole(uint row, uint height) {
    return min(row, height - 1u - row);
}

// A direction within texel (column, row), uniform in solid angle.
FN vec3 environment_direction(uint column, uint row, uint width, uint height, vec2 u) {
    bool southern = 2u * row >= height;
    float rows_from_pole = float(environment_rows_from_pole(row, height));
    float inner = sin(0.5f * PI * rows_from_pole / float(height));
    float outer = sin(0.5f * PI * (rows_from_pole + 1.0f) / float(height));
    // sin^2 of half the angle from the pole, which is linear in solid angle.
    float t = mix(inner * inner, outer * outer, southern ? 1.0f - u.y : u.y);
    float y = 1.0f - 2.0f * t;
    float horizontal = 2.0f * sqrt(t * (1.0f - t));
    float phi = 2.0f * PI * ((float(column) + u.x) / float(width) - 0.5f);
    return vec3(horizontal * sin(phi), southern ? -y : y, -horizontal * cos(phi));
}

// Solid angle of a texel in `row`, sr.
FN float environment_texel_solid_angle(uint row, uint width, uint height) {
    float step_rad = PI / float(height);
    float middle_rad = (float(environment_rows_from_pole(row, height)) + 0.5f) * step_rad;
    // cos a - cos b = 2 sin((a+b)/2) sin((b-a)/2), without cancellation at the poles.
    return (2.0f * PI / float(width)) * 2.0f * sin(middle_rad) * sin(0.5f * step_rad);
}

SHARED_END
