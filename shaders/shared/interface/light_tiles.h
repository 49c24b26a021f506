// Tiles of light samples that direct/light_tiles draws for direct/candidates, LIGHT_TILE_SIZE samples each.
#pragma once

#include "shared/dialect.h"
#include "shared/math/light.h"
#include "shared/math/light_sample.h"

SHARED_BEGIN

CONSTANT uint LIGHT_TILE_COUNT = 128u;
CONSTANT uint LIGHT_TILE_SIZE = 1024u;
CONSTANT uint LIGHT_TILE_ROWS = 4u;

// A sample of a tile: its place on a triangle is found already, texture and all. A punctual light has its
// record instead.
struct LightTileSample {
    LightSample drawn;
    float pdf;  // by power, in the measure of its light
    bool is_triangle;
    LightPlace place;
    Light punctual;
};

// The sample `drawn` on `light` with density `pdf`; `radiance` is that of a triangle there, texture included.
FN LightTileSample make_light_tile_sample(Light light, LightSample drawn, float pdf, vec3 radiance) {
    LightTileSample s;
    s.drawn = drawn;
    s.pdf = pdf;
    s.is_triangle = (light.flags & LIGHT_KIND_MASK) == LIGHT_TRIANGLE;
    s.place = place_on_triangle(light, drawn.uv, radiance);
    s.punctual = light;
    return s;
}

// What it sends to `point`, before visibility; `triangle`: what it is, or must be in this scene.
FN IncidentLight incident_from_tile_sample(LightTileSample s, bool triangle, vec3 point) {
    if (triangle) return incident_from_place(s.place, point);
    return incident_from_punctual(s.punctual, point);
}

// Rows of a triangle: (position, light), (normal, pdf), (radiance, flags), (barycentrics); of a punctual
// light: (position, light), (direction, pdf), (radiance, flags), (cone, range).
FN void pack_light_tile_sample(LightTileSample s, OUT(uvec4) row0, OUT(uvec4) row1, OUT(uvec4) row2,
                               OUT(uvec4) row3) {
    uint pdf = floatBitsToUint(s.pdf);
    if (s.is_triangle) {
        row0 = pack_row(s.place.position, s.drawn.light);
        row1 = pack_row(s.place.normal, pdf);
        row2 = pack_row(s.place.radiance, LIGHT_TRIANGLE | (s.place.double_sided ? LIGHT_DOUBLE_SIDED : 0u));
        row3 = pack_row4(vec4(s.drawn.uv.x, s.drawn.uv.y, 0.0f, 0.0f));
    } else {
        row0 = pack_row(s.punctual.position, s.drawn.light);
        row1 = pack_row(s.punctual.edge1, pdf);
        row2 = pack_row(s.punctual.radiance, s.punctual.flags);
        row3 = pack_row4(vec4(s.punctual.edge2.x, s.punctual.edge2.y, 0.0f, s.punctual.range));
    }
}

FN LightTileSample unpack_light_tile_sample(uvec4 row0, uvec4 row1, uvec4 row2, uvec4 row3) {
    LightTileSample s;
    s.is_triangle = (row2.w & LIGHT_KIND_MASK) == LIGHT_TRIANGLE;
    s.drawn.light = row0.w;
    s.drawn.uv = s.is_triangle ? vec2(uintBitsToFloat(row3.x), uintBitsToFloat(row3.y)) : vec2(0.0f);
    s.pdf = uintBitsToFloat(row1.w);
    s.place.position = row_xyz(row0);
    s.place.normal = row_xyz(row1);
    s.place.radiance = row_xyz(row2);
    s.place.double_sided = (row2.w & LIGHT_DOUBLE_SIDED) != 0u;
    s.punctual = unpack_light(uvec4(row0.x, row0.y, row0.z, row2.w), row1, row3, row2);
    s.punctual.range = uintBitsToFloat(row3.w);
    return s;
}

SHARED_END
