// Warps from the unit square to the shapes that get sampled, and orthonormal frames.
#pragma once

#include "shared/dialect.h"

SHARED_BEGIN

struct Frame {
    vec3 tangent;
    vec3 bitangent;
    vec3 normal;
};

// An orthonormal frame around a unit normal (Duff et al., "Building an Orthonormal Basis, Revisited", JCGT
// 6(1), 2017).
FN Frame make_frame(vec3 normal) {
    float sign_z = normal.z >= 0.0f ? 1.0f : -1.0f;
    float a = -1.0f / (sign_z + normal.z);
    float b = normal.x * normal.y * a;
    Frame frame;
    frame.tangent = vec3(1.0f + sign_z * normal.x * normal.x * a, sign_z * b, -sign_z * normal.x);
    frame.bitangent = vec3(b, sign_z + normal.y * normal.y * a, -normal.y);
    frame.normal = normal;
    return frame;
}

FN vec3 to_local(Frame frame, vec3 v) {
    return vec3(dot(v, frame.tangent), dot(v, frame.bitangent), dot(v, frame.normal));
}

FN vec3 from_local(Frame frame, vec3 v) {
    return frame.tangent * v.x + frame.bitangent * v.y + frame.normal * v.z;
}

// Cosine-distributed direction around +Z. Pdf, solid angle: z / pi.
FN vec3 sample_cosine_hemisphere(vec2 u) {
    float radius = sqrt(u.x);
    float phi = 2.0f * PI * u.y;
    return vec3(radius * cos(phi), radius * sin(phi), sqrt(max(0.0f, 1.0f - u.x)));
}

// Uniform direction around +Z. Pdf, solid angle: 1 / (2 pi).
FN vec3 sample_uniform_hemisphere(vec2 u) {
    float radius = sqrt(max(0.0f, 1.0f - u.x * u.x));
    float phi = 2.0f * PI * u.y;
    return vec3(radius * cos(phi), radius * sin(phi), u.x);
}

// Uniform barycentrics (weights of the second and third vertex). Pdf, area: 1 / area. The unit square is
// folded along its diagonal (Heitz, "A Low-Distortion Map Between Triangle and Square", 2019).
FN vec2 sample_triangle(vec2 u) {
    float first = u.x;
    float second = u.y;
    if (second > first) {
        first *= 0.5f;
        second -= first;
    } else {
        second *= 0.5f;
        first -= second;
    }
    return vec2(first, second);
}

SHARED_END
