// Paths that add to the radiance cache, second step: the surfaces that their rays met. What these send back is light of
// lamps, once its shadow ray is answered, and what the cache of the last frame knows.
#include "shared/interface/constants/cache.h"
#include "lib/scene_buffers.glsl"
#include "lib/frame.glsl"
#include "lib/gbuffer.glsl"
#include "lib/counters.glsl"
#include "lib/receiver.glsl"
#include "lib/indirect/next_event.glsl"
#define TARN_CACHE_WORLD
#include "lib/indirect/world_cache.glsl"
#include "lib/indirect/cached_light.glsl"
#include "lib/indirect/cache_paths.glsl"
#include "lib/pixel_group.glsl"

layout(binding = UNIT_PASS_A) uniform usamplerBuffer hits;
layout(binding = UNIT_PASS_B) uniform usamplerBuffer cells;  // of the last frame
layout(std430, binding = 0) writeonly buffer CacheSamples { uvec4 out_samples[]; };
layout(std430, binding = 1) writeonly buffer ShadowRays { uvec4 out_shadow_rays[]; };

// What a surface sends to the place from which the ray came.
struct Sent {
    vec3 known;
    vec3 waiting;  // for the shadow ray
    RayRecord shadow_ray;
};

Sent send_back(HitRecord hit, Surface surface, RandomKey key, uint index) {
    Receiver r = make_receiver(surface.point, -hit.direction);
    NextEvent light = find_next_event(r, key, DIMENSION_CACHE + 8u, 0.0f);
    Sent sent = Sent(vec3(0.0f), vec3(0.0f), inactive_ray());
    vec3 albedo = r.point.material.diffuse_albedo;
#ifdef TARN_PLANT_ALBEDO_TWICE
    albedo *= albedo;
#endif
    sent.known = albedo * base_to_viewer(r) * find_base_irradiance(cells, r);
#ifdef TARN_PLANT_COUNT_EMISSION
    sent.known += surface.emission;
#endif
    if (light.contribution_weight > 0.0f) {
        sent.shadow_ray = make_shadow_ray(r.point, light.incident, load_light_error(light.drawn), index);
        sent.waiting =
            light.contribution_weight * join_parts(r.point.material, reflect_at(r, light.incident));
    }
    return sent;
}

void main() {
    ivec2 at = ivec2(gl_GlobalInvocationID.xy);
    if (is_outside_of_cache_paths(at)) return;
    uint index = cache_path_index(at);
    int row = int(index * HIT_ROWS);
    HitRecord hit = unpack_hit(texelFetch(hits, row), texelFetch(hits, row + 1));
    Sent sent = Sent(vec3(0.0f), vec3(0.0f), inactive_ray());
    if (hit.instance != INVALID_INDEX) {
        Surface surface = evaluate_surface(hit.instance, hit.primitive, hit.barycentrics, hit.direction);
        if (!surface.unlit) sent = send_back(hit, surface, pixel_key(cache_path_pixel(at)), index);
    }
    // The direction was drawn by cosine / pi.
    out_samples[index * CACHE_SAMPLE_ROWS] = pack_row(sent.known * PI, 0u);
    out_samples[index * CACHE_SAMPLE_ROWS + 1u] = pack_row(sent.waiting * PI, 0u);
    uvec4 row0, row1;
    pack_ray(sent.shadow_ray, row0, row1);
    out_shadow_rays[index * RAY_ROWS] = row0;
    out_shadow_rays[index * RAY_ROWS + 1u] = row1;
}
