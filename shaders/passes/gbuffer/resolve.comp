// From the seen triangle to the surface: the pixel's ray is intersected with it again, so that the position is the
// one that rays meet, and every texture is read once a pixel, whatever the overdraw.
//
// The G-buffer, texels of each pixel (LAYER_*), all RGBA32F:
//   position  relative to the world's origin, and the bound on its rounding error (-1: nothing to be lit here)
//   normals   geometric and shading normal, octahedral
//   diffuse   diffuse albedo, GGX alpha
//   specular  F0, F90
//   emission  radiance towards the viewer (the sky where nothing is seen)
//   motion    where the surface was in the last frame, relative to the world's origin, and the number of its instance
//             (TARN_MOTION alone)
#include "lib/scene_buffers.glsl"
#include "lib/frame.glsl"
#include "lib/pixel_group.glsl"
#include "lib/surface_texels.glsl"

layout(binding = UNIT_PASS_A) uniform usampler2D seen_triangles;
layout(binding = 0, rgba32f) writeonly uniform imageBuffer out_surface;

void store(ivec2 pixel, int layer, vec4 texel) {
    imageStore(out_surface, surface_texel(frame_size.x, pixel, layer), texel);
}

#ifdef TARN_MOTION

// The instances of the last frame follow those of this one; theirs are its vertices too (GpuScene).
vec3 load_previous_position(uvec2 seen, vec2 barycentrics) {
    InstanceRecord instance = load_instance(seen.x + frame_history.x);
    uvec3 vertices = load_vertex_indices(instance, seen.y);
    vec3 position_os = interpolate3(load_position_os(vertices.x), load_position_os(vertices.y),
                                    load_position_os(vertices.z), barycentrics);
    return transform_point(instance, position_os);
}
#endif

// Barycentrics where the ray meets the triangle's plane, kept within the triangle: the rasterizer's pixel may lie a
// 256th of a pixel outside.
//
// Moller and Trumbore ("Fast, Minimum Storage Ray-Triangle Intersection", 1997), then the same for what is left between
// that point and the ray: on slivers the rounding of u and v would move the first answer by 1e-4 of the distance.
// Edges are taken in object space, where small triangles far away still have their digits.
vec2 intersect_triangle(PixelRay ray, uint instance_index, uint primitive) {
    InstanceRecord instance = load_instance(instance_index);
    uvec3 vertices = load_vertex_indices(instance, primitive);
    vec3 p0 = load_position_os(vertices.x);
    vec3 edge1 = transform_vector(instance, load_position_os(vertices.y) - p0);
    vec3 edge2 = transform_vector(instance, load_position_os(vertices.z) - p0);
    vec3 from_vertex = ray.origin - transform_point(instance, p0);
    vec3 h = cross(ray.direction, edge2);
    vec3 g = cross(edge1, ray.direction);
    float determinant = dot(edge1, h);
    if (determinant == 0.0f) return vec2(1.0f / 3.0f);
    float u = dot(from_vertex, h) / determinant;
    float v = dot(from_vertex, g) / determinant;
    vec3 rest = from_vertex - edge1 * u - edge2 * v;
    rest -= ray.direction * dot(rest, ray.direction);
    u += dot(rest, h) / determinant;
    v += dot(rest, g) / determinant;
    u = clamp(u, 0.0f, 1.0f);
    return vec2(u, clamp(v, 0.0f, 1.0f - u));
}

void store_sky(ivec2 pixel, vec3 direction) {
    store(pixel, LAYER_POSITION, vec4(0.0f, 0.0f, 0.0f, -1.0f));
    store(pixel, LAYER_NORMALS, vec4(0.0f));
    store(pixel, LAYER_DIFFUSE, vec4(0.0f));
    store(pixel, LAYER_SPECULAR, vec4(0.0f));
    store(pixel, LAYER_EMISSION, vec4(load_environment(direction), 0.0f));
}

void store_surface(ivec2 pixel, Surface s) {
    ShadingPoint p = s.point;
    store(pixel, LAYER_POSITION, vec4(p.position, s.unlit ? -1.0f : p.position_error));
    store(pixel, LAYER_NORMALS,
          vec4(encode_octahedral(p.geometric_normal), encode_octahedral(p.shading_normal)));
    store(pixel, LAYER_DIFFUSE, vec4(p.material.diffuse_albedo, p.material.alpha));
    store(pixel, LAYER_SPECULAR, vec4(p.material.f0, p.material.f90));
    store(pixel, LAYER_EMISSION, vec4(s.emission, 0.0f));
}

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (is_outside(pixel)) return;
    PixelRay ray = pixel_ray(pixel);
    uvec2 seen = texelFetch(seen_triangles, pixel, 0).xy;
    if (seen.x == INVALID_INDEX) {
        store_sky(pixel, ray.direction);
        return;
    }
    vec2 barycentrics = intersect_triangle(ray, seen.x, seen.y);
    store_surface(pixel, evaluate_surface(seen.x, seen.y, barycentrics, ray.direction));
#ifdef TARN_MOTION
    store(pixel, LAYER_MOTION, vec4(load_previous_position(seen, barycentrics), float(seen.x)));
#endif
}
