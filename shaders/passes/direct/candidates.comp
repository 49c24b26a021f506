// Chooses one light sample a pixel and writes the shadow ray that asks whether it is seen.
//
// TARN_DIRECT_UNIFORM: one light with equal probability, a place on it by area. The baseline.
// TARN_DIRECT_RIS: streaming resampled importance sampling (Talbot 2005; Bitterli et al. 2020, algorithm 3): M
// candidates by power, a quarter of them from the sky where there is one; target = luminance of BRDF x Le x G.
#include "lib/scene_buffers.glsl"
#include "lib/frame.glsl"
#include "lib/gbuffer.glsl"
#include "lib/counters.glsl"
#include "shared/math/shadow_ray.h"

layout(local_size_x = 8, local_size_y = 8) in;

layout(std430, binding = 0) writeonly buffer Reservoirs { uvec4 out_reservoirs[]; };
layout(std430, binding = 1) writeonly buffer Rays { uvec4 out_rays[]; };

void store(uint pixel, Reservoir reservoir, RayRecord ray) {
    uvec4 row0, row1;
    pack_reservoir(reservoir, row0, row1);
    out_reservoirs[pixel * RESERVOIR_ROWS] = row0;
    out_reservoirs[pixel * RESERVOIR_ROWS + 1u] = row1;
    pack_ray(ray, row0, row1);
    out_rays[pixel * RAY_ROWS] = row0;
    out_rays[pixel * RAY_ROWS + 1u] = row1;
}

#ifdef TARN_DIRECT_UNIFORM
uint candidate_count() { return 1u; }

LightCandidate draw_candidate(RandomKey key, uint i) {
    return draw_light_uniformly(random_bits4(key, DIMENSION_CANDIDATE + i));
}
#else
uint candidate_count() { return frame_lights.w; }

// Systematic: the sky gets its share exactly, in the same places of the loop for all pixels of a frame.
bool goes_to_sky(uint i) {
    float share = environment_probability();
    RandomKey key;
    key.pixel = 0u;
    key.frame = frame_size.z;
    key.seed = frame_size.w;
    float shift = float_from_bits(random_bits4(key, DIMENSION_SELECT).x);
    return floor(float(i + 1u) * share + shift) > floor(float(i) * share + shift);
}

LightCandidate draw_candidate(RandomKey key, uint i) {
    uvec4 bits = random_bits4(key, DIMENSION_CANDIDATE + i);
    float share = environment_probability();
    LightCandidate c;
    if (SCENE_HAS_ENVIRONMENT && goes_to_sky(i)) {
        c = draw_environment(bits);
        c.pdf *= share;
    } else if (get_light_count() > 0u) {
        c = draw_light_by_power(bits);
        c.pdf *= 1.0f - share;
    } else {
        c = no_candidate();
    }
    return c;
}
#endif

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (is_outside(pixel)) return;
    ShadingPoint p;
    if (!load_shading_point(pixel, p)) {
        store(pixel_index(pixel), empty_reservoir(), inactive_ray());
        return;
    }
    RandomKey key = pixel_key(pixel);
    Frame frame = make_frame(p.shading_normal);
    vec3 view_local = to_local(frame, -pixel_ray(pixel).direction);
    uint count = candidate_count();
    LiveReservoir live = empty_live_reservoir();
    for (uint i = 0u; i < count; ++i) {
        LightCandidate c = draw_candidate(key, i);
#ifdef TARN_PLANT_DROP_PDF
        c.pdf = 1.0f;
#endif
#ifdef TARN_PLANT_SHIFT_LIGHT
        if (c.drawn.light < get_light_count()) {
            c.drawn.light = (c.drawn.light + (get_light_count() + 1u) / 2u) % get_light_count();
        }
#endif
        IncidentLight incident = load_incident_light(c.drawn, p.position);
        float target = target_function(reflect_light(p, frame, view_local, incident));
        float weight = target == 0.0f ? 0.0f : target / (c.pdf * float(count));
        float u = random4(key, DIMENSION_SELECT + 1024u + i).x;
        if (!offer_candidate(live, c.drawn, target, weight, u)) count_event(COUNTER_BAD_WEIGHT);
    }
    Reservoir reservoir = finish_reservoir(live, float(count));
    RayRecord ray = inactive_ray();
    if (reservoir.contribution_weight > 0.0f) {
        IncidentLight incident = load_incident_light(reservoir.chosen, p.position);
        ray = make_shadow_ray(p, incident, load_light_error(reservoir.chosen), pixel_index(pixel));
    }
    store(pixel_index(pixel), reservoir, ray);
}
