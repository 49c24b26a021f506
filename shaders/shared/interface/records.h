// Records that cross the border between CPU and GL: rows of four 32-bit words, read through RGBA32UI texture
// buffers. Each has its packing beside it; tests/gpu/layout.cpp runs both sides over the same bytes.
#pragma once

#include "shared/dialect.h"
#include "shared/math/packing.h"

SHARED_BEGIN

// ---- Vertex: position, normal, tangent, two uv sets, colour
// -------------------------------------------------------

CONSTANT uint VERTEX_ROWS = 4u;

struct Vertex {
    vec3 position_os;
    vec3 normal_os;
    vec4 tangent_os;  // w = handedness; 0 where the mesh has no tangents
    vec2 uv0;
    vec2 uv1;
    vec4 color;  // unsigned normalized, 16 bits a channel
};

FN void pack_vertex(Vertex v, OUT(uvec4) row0, OUT(uvec4) row1, OUT(uvec4) row2, OUT(uvec4) row3) {
    row0 = pack_row(v.position_os, floatBitsToUint(v.uv0.x));
    row1 = pack_row(v.normal_os, floatBitsToUint(v.uv0.y));
    row2 = pack_row4(v.tangent_os);
    row3 = uvec4(floatBitsToUint(v.uv1.x), floatBitsToUint(v.uv1.y),
                 packUnorm2x16(vec2(v.color.x, v.color.y)), packUnorm2x16(vec2(v.color.z, v.color.w)));
}

// ---- Instance: a mesh in the world
// --------------------------------------------------------------------------------

CONSTANT uint INSTANCE_ROWS = 4u;
CONSTANT uint INSTANCE_MIRRORED = 1u;  // the transform turns triangles inside out (negative determinant)

struct InstanceRecord {
    vec4 world_from_object[3];  // rows of the affine matrix; relative to the world's origin
    uint first_triangle;
    uint first_vertex;
    uint material;
    uint flags;
};

FN InstanceRecord unpack_instance(uvec4 row0, uvec4 row1, uvec4 row2, uvec4 row3) {
    InstanceRecord r;
    r.world_from_object[0] = row_xyzw(row0);
    r.world_from_object[1] = row_xyzw(row1);
    r.world_from_object[2] = row_xyzw(row2);
    r.first_triangle = row3.x;
    r.first_vertex = row3.y;
    r.material = row3.z;
    r.flags = row3.w;
    return r;
}

// ---- Material
// -----------------------------------------------------------------------------------------------------

CONSTANT uint MATERIAL_ROWS = 12u;
CONSTANT uint MATERIAL_ALPHA_MASK = 1u;
CONSTANT uint MATERIAL_ALPHA_BLEND = 2u;
CONSTANT uint MATERIAL_DOUBLE_SIDED = 4u;
CONSTANT uint MATERIAL_UNLIT = 8u;

struct MaterialRecord {
    vec4 base_color;
    vec3 emission;
    float alpha_cutoff;
    float metallic;
    float roughness;
    float normal_scale;
    uint flags;
    vec3 dielectric_f0;
    float dielectric_f90;
};

FN MaterialRecord unpack_material(uvec4 row0, uvec4 row1, uvec4 row2, uvec4 row3) {
    MaterialRecord r;
    r.base_color = row_xyzw(row0);
    r.emission = row_xyz(row1);
    r.alpha_cutoff = uintBitsToFloat(row1.w);
    r.metallic = uintBitsToFloat(row2.x);
    r.roughness = uintBitsToFloat(row2.y);
    r.normal_scale = uintBitsToFloat(row2.z);
    r.flags = row2.w;
    r.dielectric_f0 = row_xyz(row3);
    r.dielectric_f90 = uintBitsToFloat(row3.w);
    return r;
}

FN void pack_material(MaterialRecord r, OUT(uvec4) row0, OUT(uvec4) row1, OUT(uvec4) row2, OUT(uvec4) row3) {
    row0 = pack_row4(r.base_color);
    row1 = pack_row(r.emission, floatBitsToUint(r.alpha_cutoff));
    row2 = uvec4(floatBitsToUint(r.metallic), floatBitsToUint(r.roughness), floatBitsToUint(r.normal_scale),
                 r.flags);
    row3 = pack_row(r.dielectric_f0, floatBitsToUint(r.dielectric_f90));
}

// ---- Texture slot: rows 4.. of a material, two each
// ---------------------------------------------------------------

CONSTANT uint SLOT_BASE_COLOR = 0u;
CONSTANT uint SLOT_METALLIC_ROUGHNESS = 1u;
CONSTANT uint SLOT_NORMAL = 2u;
CONSTANT uint SLOT_EMISSION = 3u;
CONSTANT uint SLOT_PRESENT = 64u;
CONSTANT uint SLOT_NEAREST = 16u;
CONSTANT uint SLOT_SECOND_UV = 32u;

struct SlotRecord {
    uint first_texel;
    uint size;   // width | height << 16
    uint flags;  // wrap u (2 bits), wrap v (2 bits), SLOT_*
    float rotation_rad;
    vec2 offset;
    vec2 scale;
};

FN SlotRecord unpack_slot(uvec4 row0, uvec4 row1) {
    SlotRecord r;
    r.first_texel = row0.x;
    r.size = row0.y;
    r.flags = row0.z;
    r.rotation_rad = uintBitsToFloat(row0.w);
    r.offset = vec2(uintBitsToFloat(row1.x), uintBitsToFloat(row1.y));
    r.scale = vec2(uintBitsToFloat(row1.z), uintBitsToFloat(row1.w));
    return r;
}

FN void pack_slot(SlotRecord r, OUT(uvec4) row0, OUT(uvec4) row1) {
    row0 = uvec4(r.first_texel, r.size, r.flags, floatBitsToUint(r.rotation_rad));
    row1 = pack_row4(vec4(r.offset.x, r.offset.y, r.scale.x, r.scale.y));
}

// ---- Ray: from a shader to the ray tracer
// --------------------------------------------------------------------

CONSTANT uint RAY_ROWS = 2u;
// Flag in `pixel`: a ray of the last frame. It meets that frame's geometry, by that frame's coverage.
CONSTANT uint RAY_PREVIOUS = 0x80000000u;

struct RayRecord {
    vec3 origin;     // relative to the world's origin
    float max_t;     // in units of |direction|; negative: an inactive ray, answered "visible" without tracing
    vec3 direction;  // any length but 0
    uint pixel;      // for the random numbers of partial coverage; may carry RAY_PREVIOUS
};

FN RayRecord inactive_ray() {
    RayRecord ray;
    ray.origin = vec3(0.0f);
    ray.max_t = -1.0f;
    ray.direction = vec3(0.0f, 0.0f, 1.0f);
    ray.pixel = 0u;
    return ray;
}

FN void pack_ray(RayRecord ray, OUT(uvec4) row0, OUT(uvec4) row1) {
    row0 = pack_row(ray.origin, floatBitsToUint(ray.max_t));
    row1 = pack_row(ray.direction, ray.pixel);
}

FN RayRecord unpack_ray(uvec4 row0, uvec4 row1) {
    RayRecord ray;
    ray.origin = row_xyz(row0);
    ray.max_t = uintBitsToFloat(row0.w);
    ray.direction = row_xyz(row1);
    ray.pixel = row1.w;
    return ray;
}

// ---- Hit: what the ray tracer answers
// --------------------------------------------------------------------------------------

CONSTANT uint HIT_ROWS = 2u;

struct HitRecord {
    uint instance;      // INVALID_INDEX where nothing was met
    uint primitive;     // within the mesh
    vec2 barycentrics;  // weights of the second and third vertex
    vec3 direction;     // of the ray, so that whoever reads the hit needs no other table
    // In units of |direction|; RAY_INFINITY: the ray left the scene; negative: it was not traced.
    float distance;
};

// The hit of a ray that met nothing, or that was not traced.
FN HitRecord no_hit(vec3 direction, bool traced) {
    HitRecord hit;
    hit.instance = INVALID_INDEX;
    hit.primitive = INVALID_INDEX;
    hit.barycentrics = vec2(0.0f);
    hit.direction = direction;
    hit.distance = traced ? RAY_INFINITY : -1.0f;
    return hit;
}

FN void pack_hit(HitRecord hit, OUT(uvec4) row0, OUT(uvec4) row1) {
    row0 = uvec4(hit.instance, hit.primitive, floatBitsToUint(hit.barycentrics.x),
                 floatBitsToUint(hit.barycentrics.y));
    row1 = pack_row(hit.direction, floatBitsToUint(hit.distance));
}

FN HitRecord unpack_hit(uvec4 row0, uvec4 row1) {
    HitRecord hit;
    hit.instance = row0.x;
    hit.primitive = row0.y;
    hit.barycentrics = vec2(uintBitsToFloat(row0.z), uintBitsToFloat(row0.w));
    hit.direction = row_xyz(row1);
    hit.distance = uintBitsToFloat(row1.w);
    return hit;
}

// ---- Camera
// -------------------------------------------------------------------------------------------------------

// The view through a pixel: perspective: direction = forward + x right + y up; orthographic: origin moves
// instead.
struct CameraRecord {
    vec3 position;  // relative to the world's origin
    vec3 right;     // half the width of the image plane at distance 1 (orthographic: in metres)
    vec3 up;        // half its height, towards row 0
    vec3 forward;   // unit
    bool orthographic;
};

struct PixelRay {
    vec3 origin;
    vec3 direction;  // unit
};

// The ray through (x, y) in pixels, (0.5, 0.5) being the centre of the upper left pixel.
FN PixelRay camera_ray(CameraRecord camera, vec2 position_px, vec2 size_px) {
    float x = 2.0f * position_px.x / size_px.x - 1.0f;
    float y = 1.0f - 2.0f * position_px.y / size_px.y;
    vec3 on_plane = camera.right * x + camera.up * y;
    PixelRay ray;
    ray.origin = camera.orthographic ? camera.position + on_plane : camera.position;
    ray.direction = camera.orthographic ? camera.forward : normalize(camera.forward + on_plane);
    return ray;
}

SHARED_END
