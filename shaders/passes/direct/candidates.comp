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

// What the loop over candidates works on.
struct Stream {
    ShadingPoint point;
    Frame frame;
    vec3 view_local;
    RandomKey key;
    uint count;
    LiveReservoir live;
};

// Offers candidate `i`, drawn with `c.pdf`, with resampling weight target / (pdf * count).
void offer(inout Stream s, LightCandidate c, uint i) {
#ifdef TARN_PLANT_DROP_PDF
    c.pdf = 1.0f;
#endif
#ifdef TARN_PLANT_SHIFT_LIGHT
    if (c.drawn.light < get_light_count()) {
        c.drawn.light = (c.drawn.light + (get_light_count() + 1u) / 2u) % get_light_count();
    }
#endif
    IncidentLight incident = load_incident_light(c.drawn, s.point.position);
    float target = target_function(reflect_light(s.point, s.frame, s.view_local, incident));
    float weight = target == 0.0f ? 0.0f : target / (c.pdf * float(s.count));
    float u = random4(s.key, DIMENSION_CHOICE + i).x;
    if (!offer_candidate(s.live, c.drawn, target, weight, u)) count_event(COUNTER_BAD_WEIGHT);
}

#ifdef TARN_DIRECT_UNIFORM
uint candidate_count() { return 1u; }

void offer_all(inout Stream s) { offer(s, draw_light_uniformly(random_bits4(s.key, DIMENSION_CANDIDATE)), 0u); }
#else
uint candidate_count() { return frame_lights.w; }

// How many of `count` candidates go to the sky: its share, rounded up or down at random, alike for all pixels of a
// frame. Each kind of light has a loop of its own, since a software GPU runs both sides of a branch.
uint sky_candidate_count(uint count) {
    RandomKey key;
    key.pixel = 0u;
    key.frame = frame_size.z;
    key.seed = frame_size.w;
    float shift = random4(key, DIMENSION_SELECT).x;
    return min(count, uint(floor(float(count) * environment_probability() + shift)));
}

void offer_all(inout Stream s) {
    float share = environment_probability();
    uint sky_count = SCENE_HAS_ENVIRONMENT ? sky_candidate_count(s.count) : 0u;
    if (SCENE_HAS_ENVIRONMENT) {
        for (uint i = 0u; i < sky_count; ++i) {
            LightCandidate c = draw_environment(random_bits4(s.key, DIMENSION_CANDIDATE + i));
            c.pdf *= share;
            offer(s, c, i);
        }
    }
    if (get_light_count() > 0u) {
        for (uint i = sky_count; i < s.count; ++i) {
            LightCandidate c = draw_light_by_power(random_bits4(s.key, DIMENSION_CANDIDATE + i));
            c.pdf *= 1.0f - share;
            offer(s, c, i);
        }
    }
}
#endif

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (is_outside(pixel)) return;
    Stream s;
    if (!load_shading_point(pixel, s.point)) {
        store(pixel_index(pixel), empty_reservoir(), inactive_ray());
        return;
    }
    s.key = pixel_key(pixel);
    s.frame = make_frame(s.point.shading_normal);
    s.view_local = to_local(s.frame, -pixel_ray(pixel).direction);
    s.count = candidate_count();
    s.live = empty_live_reservoir();
    offer_all(s);
    Reservoir reservoir = finish_reservoir(s.live, float(s.count));
    if (s.live.weight_sum > 0.0f && reservoir.contribution_weight == 0.0f) count_event(COUNTER_BAD_RESERVOIR);
    RayRecord ray = inactive_ray();
    if (reservoir.contribution_weight > 0.0f) {
        IncidentLight incident = load_incident_light(reservoir.chosen, s.point.position);
        ray = make_shadow_ray(s.point, incident, load_light_error(reservoir.chosen), pixel_index(pixel));
    }
    store(pixel_index(pixel), reservoir, ray);
}
