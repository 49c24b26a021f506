// Packing of vectors into fewer numbers, and of records into rows of four words.
#pragma once

#include "shared/dialect.h"

SHARED_BEGIN

FN float sign_not_zero(float x) {
    return x >= 0.0f ? 1.0f : -1.0f;
}

// Unit vector to the octahedron's unfolded square, [-1, 1]^2 (Cigolle et al., "A Survey of Efficient
// Representations for Independent Unit Vectors", JCGT 3(2), 2014). Kept in 32-bit floats: the round trip is
// good to 1e-6.
FN vec2 encode_octahedral(vec3 n) {
    float scale = 1.0f / (abs(n.x) + abs(n.y) + abs(n.z));
    vec2 p = vec2(n.x * scale, n.y * scale);
    if (n.z < 0.0f) {
        p = vec2((1.0f - abs(p.y)) * sign_not_zero(p.x), (1.0f - abs(p.x)) * sign_not_zero(p.y));
    }
    return p;
}

FN vec3 decode_octahedral(vec2 p) {
    vec3 n = vec3(p.x, p.y, 1.0f - abs(p.x) - abs(p.y));
    if (n.z < 0.0f) {
        float x = n.x;
        n.x = (1.0f - abs(n.y)) * sign_not_zero(x);
        n.y = (1.0f - abs(x)) * sign_not_zero(n.y);
    }
    return normalize(n);
}

// A record is a whole number of rows of four 32-bit words; floats travel as their bits.
FN uvec4 pack_row(vec3 v, uint w) {
    return uvec4(floatBitsToUint(v.x), floatBitsToUint(v.y), floatBitsToUint(v.z), w);
}

FN uvec4 pack_row4(vec4 v) {
    return uvec4(floatBitsToUint(v.x), floatBitsToUint(v.y), floatBitsToUint(v.z), floatBitsToUint(v.w));
}

FN vec3 row_xyz(uvec4 row) {
    return vec3(uintBitsToFloat(row.x), uintBitsToFloat(row.y), uintBitsToFloat(row.z));
}

FN vec4 row_xyzw(uvec4 row) {
    return vec4(uintBitsToFloat(row.x), uintBitsToFloat(row.y), uintBitsToFloat(row.z),
                uintBitsToFloat(row.w));
}

SHARED_END
