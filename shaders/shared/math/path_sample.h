// A path sample: where a path from a pixel first met a surface, and the light that arrives there. What
// indirect light resamples.
//
// The place is kept as a point of the scene's triangles, so that it moves with them. What it reflects to a
// receiver is BRDF * cosine * incident: exact for every receiver that sees it, also where it is glossy, and
// no texture is read again. (The reconnection vertex of Lin et al., "Generalized Resampled Importance
// Sampling", 2022, section 7; Ouyang et al., "ReSTIR GI", 2021, keep a radiance instead, which is right for
// Lambert alone.) Normal, direction and material are rounded to 16 bits once, before anything is computed
// from them. Which light it comes from is known, so that a lamp that is dimmed or goes out does so in old
// samples too.
#pragma once

#include "shared/dialect.h"
#include "shared/math/brdf.h"
#include "shared/math/light_sample.h"
#include "shared/math/packing.h"

SHARED_BEGIN

struct PathSample {
    uint instance;   // INVALID_INDEX: no sample
    uint primitive;  // within the mesh; PATH_BACK_FACE: it was met from behind
    vec2 barycentrics;
    vec3 shading_normal;  // on the side that was met
    SurfaceMaterial material;
    vec3 incident_direction;  // unit, from the place towards where its light comes from
    vec3 incident;            // that light over the density of its direction, visibility included
    LightSample light;        // where it comes from; none: from another surface
};

CONSTANT uint PATH_BACK_FACE = 0x80000000u;

FN PathSample no_path_sample() {
    PathSample none;
    none.instance = INVALID_INDEX;
    none.primitive = 0u;
    none.barycentrics = vec2(0.0f);
    none.shading_normal = vec3(0.0f, 0.0f, 1.0f);
    none.material.diffuse_albedo = vec3(0.0f);
    none.material.f0 = vec3(0.0f);
    none.material.f90 = 0.0f;
    none.material.alpha = 1.0f;
    none.incident_direction = vec3(0.0f, 0.0f, 1.0f);
    none.incident = vec3(0.0f);
    none.light = no_light_sample();
    return none;
}

// ---- Packing
// ------------------------------------------------------------------------------------------------------

// A place in [-1, 1]^2 in one word.
FN uint pack_square(vec2 p) {
    return packUnorm2x16(vec2(0.5f + 0.5f * p.x, 0.5f + 0.5f * p.y));
}

FN vec2 unpack_square(uint word) {
    vec2 p = unpackUnorm2x16(word);
    return vec2(2.0f * p.x - 1.0f, 2.0f * p.y - 1.0f);
}

// A unit vector in one word, to within 1e-4.
FN uint pack_direction(vec3 direction) {
    return pack_square(encode_octahedral(direction));
}

FN vec3 unpack_direction(uint word) {
    return decode_octahedral(unpack_square(word));
}

// A material in one row; of the width its root is kept, the roughness.
FN uvec4 pack_surface_material(SurfaceMaterial m) {
    return uvec4(packUnorm2x16(vec2(m.diffuse_albedo.x, m.diffuse_albedo.y)),
                 packUnorm2x16(vec2(m.diffuse_albedo.z, sqrt(m.alpha))), packUnorm2x16(vec2(m.f0.x, m.f0.y)),
                 packUnorm2x16(vec2(m.f0.z, m.f90)));
}

FN SurfaceMaterial unpack_surface_material(uvec4 row) {
    vec2 xy = unpackUnorm2x16(row.x);
    vec2 z_roughness = unpackUnorm2x16(row.y);
    vec2 f0_xy = unpackUnorm2x16(row.z);
    vec2 f0_z_f90 = unpackUnorm2x16(row.w);
    SurfaceMaterial m;
    m.diffuse_albedo = vec3(xy.x, xy.y, z_roughness.x);
    m.f0 = vec3(f0_xy.x, f0_xy.y, f0_z_f90.x);
    m.f90 = f0_z_f90.y;
    m.alpha = max(z_roughness.y * z_roughness.y, MIN_ALPHA);
    return m;
}

// Three words in a reservoir's head, and rows of its own behind the reservoir's (math/reservoir.h).
CONSTANT uint PATH_SAMPLE_ROWS = 3u;

FN uvec3 pack_path_head(PathSample s) {
    return uvec3(s.instance, s.primitive, pack_direction(s.shading_normal));
}

FN void pack_path_rows(PathSample s, OUT(uvec4) place, OUT(uvec4) material, OUT(uvec4) light) {
    place = uvec4(floatBitsToUint(s.barycentrics.x), floatBitsToUint(s.barycentrics.y),
                  pack_direction(s.incident_direction), s.light.light);
    material = pack_surface_material(s.material);
    light = pack_row(s.incident, pack_square(s.light.uv));
}

FN PathSample unpack_path_sample(uvec3 head, uvec4 place, uvec4 material, uvec4 light) {
    PathSample s;
    s.instance = head.x;
    s.primitive = head.y;
    s.shading_normal = unpack_direction(head.z);
    s.barycentrics = vec2(uintBitsToFloat(place.x), uintBitsToFloat(place.y));
    s.incident_direction = unpack_direction(place.z);
    s.material = unpack_surface_material(material);
    s.incident = row_xyz(light);
    s.light.light = place.w;
    s.light.uv = unpack_square(light.w);
    return s;
}

// ---- The reconnection shift
// ------------------------------------------------------------------------------------------------------

// Shifts that stretch or shrink solid angles more than this are none: such receivers hardly share a place.
CONSTANT float MAX_RECONNECTION_JACOBIAN = 10.0f;
// Narrower lobes than this, at the receiver or at the place, do not reconnect: a roughness of 0.2.
CONSTANT float MIN_RECONNECTION_ALPHA = 0.04f;

// Solid angle of a place on a surface as `to` sees it over that as `from` sees it: |dT/dx| of the shift that
// keeps the place (Ouyang et al. 2021, equation 11, with the geometric normal). `normal` is unit. 0 where one
// of the two does not see the front of the place, or where the ratio is beyond the bound: to the bit the same
// decision both ways.
FN float reconnection_jacobian(vec3 from, vec3 to, vec3 place, vec3 normal) {
    vec3 to_from = from - place;
    vec3 to_to = to - place;
    float from_cosine = dot(normal, to_from);  // times the distance
    float to_cosine = dot(normal, to_to);
    if (!(from_cosine > 0.0f) || !(to_cosine > 0.0f)) return 0.0f;
    float from2 = dot(to_from, to_from);
    float to2 = dot(to_to, to_to);
    float from_cubed = from2 * sqrt(from2);
    float to_cubed = to2 * sqrt(to2);
    float numerator = to_cosine * from_cubed;
    float denominator = from_cosine * to_cubed;
    if (!(max(numerator, denominator) <= MAX_RECONNECTION_JACOBIAN * min(numerator, denominator)))
        return 0.0f;
    return ratio_or_zero(numerator, denominator);
}

SHARED_END
