// The environment map: an equirectangular picture of the sky, +Y up, its top row at the zenith, u = 0.5 towards -Z.
// Radiance is bilinear between texel centres; the sampling density is constant in solid angle over each texel.
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

// A direction within texel (column, row), uniform in solid angle.
FN vec3 environment_direction(uint column, uint row, uint width, uint height, vec2 u) {
    float y_upper = cos(PI * float(row) / float(height));
    float y_lower = cos(PI * float(row + 1u) / float(height));
    float y = clamp(mix(y_upper, y_lower, u.y), -1.0f, 1.0f);
    float phi = 2.0f * PI * ((float(column) + u.x) / float(width) - 0.5f);
    float horizontal = sqrt(max(0.0f, 1.0f - y * y));
    return vec3(horizontal * sin(phi), y, -horizontal * cos(phi));
}

// Solid angle of a texel in `row`, sr.
FN float environment_texel_solid_angle(uint row, uint width, uint height) {
    float top = PI * float(row) / float(height);
    float bottom = PI * float(row + 1u) / float(height);
    // cos a - cos b = 2 sin((a+b)/2) sin((b-a)/2), without cancellation at the poles.
    return (2.0f * PI / float(width)) * 2.0f * sin(0.5f * (top + bottom)) * sin(0.5f * (bottom - top));
}

SHARED_END
