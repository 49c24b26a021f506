// One surface on the way of each pixel's path: light that arrives there by next-event estimation, the shadow ray that
// tests it, and the ray on which the path goes on.
//
// TARN_FIRST_VERTEX: the surface becomes the place of the pixel's sample. TARN_LAST_VERTEX: the path ends here.
// TARN_CACHE_SCREEN, TARN_CACHE_WORLD: what lies beyond the path's end comes out of a cache (lib/indirect/cached_light.glsl).
// Lamps that the path's ray meets count as far as light sampling leaves them to it; what a pixel sees directly is direct
// light's.
#include "shared/interface/constants/indirect.h"
#include "lib/scene_buffers.glsl"
#include "lib/frame.glsl"
#include "lib/gbuffer.glsl"
#include "lib/counters.glsl"
#include "lib/receiver.glsl"
#include "lib/indirect/directions.glsl"
#include "lib/indirect/next_event.glsl"
#include "lib/indirect/path_state.glsl"
#include "lib/indirect/met_light.glsl"
#ifdef TARN_CACHE_WORLD
#include "lib/indirect/world_cache.glsl"
#endif
#include "lib/indirect/cached_light.glsl"
#include "lib/pixel_group.glsl"

layout(binding = UNIT_PASS_A) uniform usamplerBuffer hits;
layout(binding = UNIT_PASS_B) uniform samplerBuffer answers;          // of the vertex before
layout(binding = UNIT_PASS_C) uniform usamplerBuffer in_path_states;  // of the vertex before
#ifdef TARN_CACHE_WORLD
layout(binding = UNIT_PASS_D) uniform usamplerBuffer cache_cells;  // of the last frame
#endif
layout(std430, binding = 0) writeonly buffer PathStates { uvec4 out_states[]; };
layout(std430, binding = 1) writeonly buffer ShadowRays { uvec4 out_shadow_rays[]; };
layout(std430, binding = 2) writeonly buffer Rays { uvec4 out_rays[]; };

void store_state(uint pixel, PathState s) {
    uint row = pixel * PATH_STATE_ROWS;
    uvec4 place, material, light;
    pack_path_rows(s.place, place, material, light);
    out_states[row] = uvec4(pack_path_head(s.place), pack_direction(s.further_direction));
    out_states[row + 1u] = place;
    out_states[row + 2u] = material;
    out_states[row + 3u] = light;
    out_states[row + 4u] = pack_row(s.further, s.further_is_irradiance ? 1u : 0u);
    out_states[row + 5u] = pack_row(s.throughput, pack_direction(s.normal));
    out_states[row + 6u] = pack_row(s.waiting, 0u);
    out_states[row + 7u] = pack_row(s.position, floatBitsToUint(s.pdf));
}

void store_shadow_ray(uint pixel, RayRecord ray) {
    uvec4 row0, row1;
    pack_ray(ray, row0, row1);
    out_shadow_rays[pixel * RAY_ROWS] = row0;
    out_shadow_rays[pixel * RAY_ROWS + 1u] = row1;
}

void store_next_ray(uint pixel, RayRecord ray) {
    if (ray_share == 0.0f) return;
    uvec4 row0, row1;
    pack_ray(ray, row0, row1);
    out_rays[pixel * RAY_ROWS] = row0;
    out_rays[pixel * RAY_ROWS + 1u] = row1;
}

PathState start_state(uint pixel, HitRecord hit) {
    PathState s;
#ifdef TARN_FIRST_VERTEX
    s.place = no_path_sample();
    s.further_direction = vec3(0.0f, 0.0f, 1.0f);
    s.further = vec3(0.0f);
    s.further_is_irradiance = false;
    s.throughput = vec3(0.0f);
#else
    s = load_path_state(in_path_states, pixel);
    settle_waiting(s, texelFetch(answers, int(pixel)).x, bounce == 1u);
    s.further += find_met_light(s, hit, 1.0f).value;
#endif
    s.waiting = vec3(0.0f);
    s.position = vec3(0.0f);
    s.normal = vec3(0.0f, 0.0f, 1.0f);
    s.pdf = 0.0f;
    return s;
}

// The place and the light that reaches it, as the sample keeps them.
void keep_place(inout PathState s, HitRecord hit, Receiver r, NextEvent light) {
    InstanceRecord instance = load_instance(hit.instance);
    uvec3 v = load_vertex_indices(instance, hit.primitive);
    vec3 p0 = load_position_os(v.x);
    vec3 front = transform_normal(instance, cross(load_position_os(v.y) - p0, load_position_os(v.z) - p0));
    s.place.instance = hit.instance;
    s.place.primitive = hit.primitive | (dot(front, r.point.geometric_normal) < 0.0f ? PATH_BACK_FACE : 0u);
    s.place.barycentrics = hit.barycentrics;
    s.place.shading_normal = r.point.shading_normal;
    s.place.material = r.point.material;
    s.place.incident_direction = light.incident.direction;
    s.place.incident = light.incident.value * light.contribution_weight;
    s.place.light = light.drawn;
}

// Where the path goes on; adds that step to the throughput. Of paths that end here a share looks for lamps.
RayRecord continue_path(inout PathState s, Receiver r, RandomKey key, uint pixel) {
    vec4 u = random4(key, DIMENSION_INDIRECT + (bounce + 1u) * DIMENSIONS_PER_BOUNCE);
    vec3 local = sample_brdf(r.point.material, r.brdf, u.xyz);
    float pdf = pdf_brdf_solid_angle(r.point.material, r.brdf, local);
    vec3 direction = from_local(r.frame, local);
    RayRecord ray = leave_surface(r.point, direction, pdf, pixel);
    if (u.w >= ray_share) ray.max_t = -1.0f;
    if (ray.max_t < 0.0f) return ray;
    s.position = r.point.position;
    s.normal = r.point.shading_normal;
    s.pdf = pdf;
#ifdef TARN_FIRST_VERTEX
    s.further_direction = direction;
    s.throughput = vec3(1.0f / pdf);
#else
    s.throughput *= join_parts(r.point.material, evaluate_brdf_parts(r.point.material, r.brdf, local)) *
                    (max(local.z, 0.0f) / pdf);
#endif
    return ray;
}

#ifdef TARN_CACHE
void add_cached_light(inout PathState s, HitRecord hit, Receiver r, vec3 emission) {
#ifdef TARN_CACHE_SCREEN
    vec3 irradiance = find_light_in_view(hit, r);
#else
    vec3 irradiance = find_base_irradiance(cache_cells, r);
#endif
#ifdef TARN_PLANT_COUNT_EMISSION
    irradiance += PI * emission;
#endif
#ifdef TARN_PLANT_ALBEDO_TWICE
    irradiance *= r.point.material.diffuse_albedo;
#endif
    if (!is_finite3(irradiance)) {
        count_event(COUNTER_BAD_CACHE);
        irradiance = vec3(0.0f);
    }
#ifdef TARN_FIRST_VERTEX
    s.further = irradiance;
    s.further_is_irradiance = true;
#else
    s.further += s.throughput * r.point.material.diffuse_albedo * base_to_viewer(r) * irradiance;
#endif
}
#endif

void main() {
    ivec2 at = ivec2(gl_GlobalInvocationID.xy);
    if (is_outside(at)) return;
    uint pixel = pixel_index(at);
    int row = int(pixel * HIT_ROWS);
    HitRecord hit = unpack_hit(texelFetch(hits, row), texelFetch(hits, row + 1));
    PathState s = start_state(pixel, hit);
    RayRecord shadow_ray = inactive_ray();
    RayRecord next_ray = inactive_ray();
    if (hit.instance != INVALID_INDEX) {
        Surface surface = evaluate_surface(hit.instance, hit.primitive, hit.barycentrics, hit.direction);
        if (!surface.unlit) {
            Receiver r = make_receiver(surface.point, -hit.direction);
            RandomKey key = pixel_key(at);
            NextEvent light =
                find_next_event(r, key, DIMENSION_INDIRECT + bounce * DIMENSIONS_PER_BOUNCE + 8u, ray_share);
            if (light.contribution_weight > 0.0f)
                shadow_ray = make_shadow_ray(r.point, light.incident, load_light_error(light.drawn), pixel);
#ifdef TARN_FIRST_VERTEX
            keep_place(s, hit, r, light);
#else
#ifdef TARN_PLANT_COUNT_EMISSION
            s.further += s.throughput * surface.emission;
#endif
            s.waiting = s.throughput * light.contribution_weight *
                        join_parts(r.point.material, reflect_at(r, light.incident));
#endif
#ifdef TARN_CACHE
            add_cached_light(s, hit, r, surface.emission);
#endif
            next_ray = continue_path(s, r, key, pixel);
        }
    }
    store_state(pixel, s);
    store_shadow_ray(pixel, shadow_ray);
    store_next_ray(pixel, next_ray);
}
