// Lights as the resampling sees them: a record, and what one sample of it sends to a point.
//
// Sample domains ("measure"): triangles by area, the environment by solid angle, punctual lights are a single
// point. `IncidentLight::value` already holds the light's side of the geometry term in that measure, so for
// every kind
//     reflected radiance = BRDF * max(0, n.wi) * value / pdf_in_measure.
#pragma once

#include "shared/dialect.h"
#include "shared/math/packing.h"

SHARED_BEGIN

CONSTANT uint LIGHT_POINT = 0u;
CONSTANT uint LIGHT_SPOT = 1u;
CONSTANT uint LIGHT_DIRECTIONAL = 2u;
CONSTANT uint LIGHT_TRIANGLE = 3u;
CONSTANT uint LIGHT_KIND_MASK = 7u;
CONSTANT uint LIGHT_DOUBLE_SIDED = 8u;  // a triangle that emits on both sides
CONSTANT uint LIGHT_TEXTURED = 16u;     // radiance is scaled by the material's emission map
CONSTANT uint LIGHT_COVERED = 64u;      // a triangle of partial coverage (alpha MASK or BLEND)
CONSTANT uint LIGHT_MIRRORED =
    32u;  // a triangle whose transform turned it inside out: its lit side is the other

// The light index that stands for the environment map.
CONSTANT uint LIGHT_ENVIRONMENT = 0xfffffffeu;

// Row layout in `pack_light`. Positions are relative to the world's origin.
struct Light {
    vec3 position;         // triangle: first vertex
    uint flags;            // kind and LIGHT_* bits
    float position_error;  // bound on the rounding error of positions on the light, metres; 0: no surface
    vec3 edge1;            // triangle: second vertex - first; spot, directional: unit direction of travel
    uint instance;         // triangle: where it comes from
    vec3 edge2;            // triangle: third vertex - first; spot: (angle scale, angle offset, 0)
    uint primitive;
    vec3 radiance;  // triangle: W sr^-1 m^-2; point, spot: W/sr; directional: W/m^2
    float range;    // point, spot: metres, 0 = unlimited; LIGHT_TEXTURED: place of its EmissionMap
};

CONSTANT uint LIGHT_ROWS = 4u;

// Flags and error share a word: the low eight bits of the error's mantissa make room.
CONSTANT uint LIGHT_FLAG_BITS = 0xffu;

FN float unpack_light_error(uvec4 row0) {
    return uintBitsToFloat(row0.w & ~LIGHT_FLAG_BITS);
}

FN Light unpack_light(uvec4 row0, uvec4 row1, uvec4 row2, uvec4 row3) {
    Light light;
    light.position = row_xyz(row0);
    light.flags = row0.w & LIGHT_FLAG_BITS;
    light.position_error = unpack_light_error(row0);
    light.edge1 = row_xyz(row1);
    light.instance = row1.w;
    light.edge2 = row_xyz(row2);
    light.primitive = row2.w;
    light.radiance = row_xyz(row3);
    light.range = uintBitsToFloat(row3.w);
    return light;
}

FN void pack_light(Light light, OUT(uvec4) row0, OUT(uvec4) row1, OUT(uvec4) row2, OUT(uvec4) row3) {
    // Rounded up, so that it still is a bound.
    uint error = (floatBitsToUint(light.position_error) + LIGHT_FLAG_BITS) & ~LIGHT_FLAG_BITS;
    row0 = pack_row(light.position, light.flags | error);
    row1 = pack_row(light.edge1, light.instance);
    row2 = pack_row(light.edge2, light.primitive);
    row3 = pack_row(light.radiance, floatBitsToUint(light.range));
}

// The emission map of a LIGHT_TEXTURED triangle, ready to be looked up: texture transform applied, its
// texels' place known. These rows follow those of all lights in the same table.
struct EmissionMap {
    vec2 uv0;  // at the three vertices
    vec2 uv1;
    vec2 uv2;
    uint first_texel;
    uint size;   // width | height << 16
    uint flags;  // wrap modes and SLOT_NEAREST, as in SlotRecord
};

CONSTANT uint EMISSION_MAP_ROWS = 3u;
// Added to the row's number where it travels in `range`, so that its bits are those of a normal float: a GPU
// may take small numbers for denormal ones and flush them to 0.
CONSTANT uint EMISSION_MAP_TAG = 0x40000000u;

FN void pack_emission_map(EmissionMap m, OUT(uvec4) row0, OUT(uvec4) row1, OUT(uvec4) row2) {
    row0 = pack_row4(vec4(m.uv0.x, m.uv0.y, m.uv1.x, m.uv1.y));
    row1 = uvec4(floatBitsToUint(m.uv2.x), floatBitsToUint(m.uv2.y), m.first_texel, m.size);
    row2 = uvec4(m.flags, 0u, 0u, 0u);
}

FN EmissionMap unpack_emission_map(uvec4 row0, uvec4 row1, uvec4 row2) {
    EmissionMap m;
    m.uv0 = vec2(uintBitsToFloat(row0.x), uintBitsToFloat(row0.y));
    m.uv1 = vec2(uintBitsToFloat(row0.z), uintBitsToFloat(row0.w));
    m.uv2 = vec2(uintBitsToFloat(row1.x), uintBitsToFloat(row1.y));
    m.first_texel = row1.z;
    m.size = row1.w;
    m.flags = row2.x;
    return m;
}

// One sample as a point sees it, before visibility.
struct IncidentLight {
    vec3 direction;     // unit, from the point to the light
    float distance;     // metres; RAY_INFINITY for directional lights and the environment
    vec3 value;         // see the head of this file; exactly 0 where nothing arrives
    vec3 light_normal;  // unit normal of a triangle, on the side of the point; 0 for other kinds
};

FN IncidentLight no_incident_light() {
    IncidentLight none;
    none.direction = vec3(0.0f, 1.0f, 0.0f);
    none.distance = 0.0f;
    none.value = vec3(0.0f);
    none.light_normal = vec3(0.0f);
    return none;
}

// Inverse-square falloff with the smooth window of KHR_lights_punctual where a range is given.
FN float punctual_falloff(float distance, float range) {
    float falloff = 1.0f / (distance * distance);
    if (range > 0.0f) {
        float q = distance / range;
        falloff *= clamp(1.0f - q * q * q * q, 0.0f, 1.0f);
    }
    return falloff;
}

FN float triangle_area(Light light) {
    return 0.5f * length(cross(light.edge1, light.edge2));
}

FN vec3 triangle_point(Light light, vec2 barycentrics) {
    return light.position + light.edge1 * barycentrics.x + light.edge2 * barycentrics.y;
}

// A place on a triangle light, seen from its emitting side.
struct LightPlace {
    vec3 position;  // relative to the world's origin, metres
    vec3 normal;    // unit, on the emitting side; 0 for a triangle without area
    vec3 radiance;  // W sr^-1 m^-2, texture included
    bool double_sided;
};

// The place at `barycentrics`, where the triangle emits `radiance`, texture included.
FN LightPlace place_on_triangle(Light light, vec2 barycentrics, vec3 radiance) {
    LightPlace place;
    vec3 normal = cross(light.edge1, light.edge2);
    float inv_length = ratio_or_zero(1.0f, length(normal));
    place.position = triangle_point(light, barycentrics);
    place.normal = normal * ((light.flags & LIGHT_MIRRORED) != 0u ? -inv_length : inv_length);
    place.radiance = radiance;
    place.double_sided = (light.flags & LIGHT_DOUBLE_SIDED) != 0u;
    return place;
}

// Light from a place. One without area, seen edge-on or from behind, or touching the point, sends nothing.
FN IncidentLight incident_from_place(LightPlace place, vec3 point) {
    IncidentLight incident = no_incident_light();
    vec3 to_light = place.position - point;
    float distance2 = dot(to_light, to_light);
    float distance = sqrt(distance2);
    vec3 direction = to_light / distance;
    float cosine = -dot(place.normal, direction);
    if (distance2 == 0.0f || (cosine < 0.0f && !place.double_sided)) return incident;
    incident.direction = direction;
    incident.distance = distance;
    incident.light_normal = cosine < 0.0f ? -place.normal : place.normal;
    incident.value = place.radiance * (abs(cosine) / distance2);
    return incident;
}

// Light from a triangle at `barycentrics`, where it emits `radiance`.
FN IncidentLight incident_from_triangle(Light light, vec2 barycentrics, vec3 radiance, vec3 point) {
    return incident_from_place(place_on_triangle(light, barycentrics, radiance), point);
}

// Light from a point, spot or directional light.
FN IncidentLight incident_from_punctual(Light light, vec3 point) {
    IncidentLight incident = no_incident_light();
    uint kind = light.flags & LIGHT_KIND_MASK;
    if (kind == LIGHT_DIRECTIONAL) {
        incident.direction = -light.edge1;
        incident.distance = RAY_INFINITY;
        incident.value = light.radiance;
        return incident;
    }
    vec3 to_light = light.position - point;
    float distance2 = dot(to_light, to_light);
    if (distance2 == 0.0f) return incident;
    float distance = sqrt(distance2);
    incident.direction = to_light / distance;
    incident.distance = distance;
    float cone = 1.0f;
    if (kind == LIGHT_SPOT) {
        // KHR_lights_punctual: a linear ramp in the cosine between the cones, squared.
        cone = clamp(-dot(light.edge1, incident.direction) * light.edge2.x + light.edge2.y, 0.0f, 1.0f);
        cone *= cone;
    }
    incident.value = light.radiance * (cone * punctual_falloff(distance, light.range));
    return incident;
}

SHARED_END
