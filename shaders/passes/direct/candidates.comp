// Chooses one light sample a pixel and writes the shadow ray that asks whether it is seen: streaming resampled
// importance sampling (Talbot 2005; Bitterli et al. 2020, algorithm 3) over `candidate_count` candidates; target =
// `target_weights` . (BRDF x Le x G). One candidate alone is plain importance sampling.
//
// How a candidate finds its light:
//   TARN_SELECT_UNIFORM  every light alike, the sky being one of them
//   TARN_SELECT_POWER    by power, a quarter of the candidates from the sky where there is one
//   TARN_SELECT_TILES    as by power, out of a tile of samples drawn in advance (direct/light_tiles)
//   TARN_SELECT_TREE     by a walk down the light tree, the sky as above
#include "shared/interface/constants/candidates.h"
#include "lib/scene_buffers.glsl"
#include "lib/frame.glsl"
#include "lib/gbuffer.glsl"
#include "lib/counters.glsl"
#include "lib/receiver.glsl"
#include "lib/direct/light_samples.glsl"
#include "shared/math/reservoir.h"
#ifdef TARN_SELECT_TILES
#include "lib/light_tiles.glsl"
#endif
#ifdef TARN_SELECT_TREE
#include "lib/light_tree.glsl"
#endif

#ifdef TARN_BRDF_CANDIDATE
#include "lib/light_hits.glsl"
#include "lib/light_ray_density.glsl"

layout(binding = UNIT_PASS_B) uniform usamplerBuffer brdf_hits;
#endif

#include "lib/pixel_group.glsl"

layout(std430, binding = 0) writeonly buffer Reservoirs { uvec4 out_reservoirs[]; };
layout(std430, binding = 1) writeonly buffer Rays { uvec4 out_rays[]; };

void store(uint pixel, LightSample chosen, Reservoir reservoir, RayRecord ray) {
    uvec4 row0, row1;
    pack_reservoir(reservoir, pack_light_sample(chosen), row0, row1);
    out_reservoirs[pixel * RESERVOIR_ROWS] = row0;
    out_reservoirs[pixel * RESERVOIR_ROWS + 1u] = row1;
    pack_ray(ray, row0, row1);
    out_rays[pixel * RAY_ROWS] = row0;
    out_rays[pixel * RAY_ROWS + 1u] = row1;
}

// The same dimension of another sample is another number.
uint sample_dimension(uint dimension) {
#ifdef TARN_PLANT_SAME_SAMPLES
    return dimension;
#endif
    return sample_index * DIMENSIONS_PER_SAMPLE + dimension;
}

// What the loop over candidates works on.
struct Stream {
    Receiver receiver;
    ivec2 pixel;
    RandomKey key;
    LightSample chosen;
    LiveReservoir live;
#ifdef TARN_SELECT_TILES
    LightTileWindow window;
#endif
};

// Density of a sample under the BRDF, in the measure of its light.
float brdf_pdf(Stream s, LightSample drawn, IncidentLight incident) {
#ifdef TARN_BRDF_CANDIDATE
    float pdf = pdf_brdf_solid_angle(s.receiver.point.material, s.receiver.brdf,
                                     to_local(s.receiver.frame, incident.direction));
    return ray_density_on_light(pdf, drawn, incident);
#else
    return 0.0f;
#endif
}

// Offers candidate `i`, drawn with `c.pdf`, which sends `incident`. All ways to draw a sample share it by
// the balance heuristic: resampling weight target / (count * pdf + pdf of the BRDF's candidate).
void offer_incident(inout Stream s, LightCandidate c, IncidentLight incident, uint i) {
#ifdef TARN_PLANT_DROP_PDF
    c.pdf = 1.0f;
#endif
    float target = target_at(s.receiver, incident);
    float density = c.pdf * float(candidate_count) + brdf_pdf(s, c.drawn, incident);
    float weight = target == 0.0f ? 0.0f : target / density;
    float u = random4(s.key, sample_dimension(DIMENSION_CHOICE + i)).x;
    uint offer = offer_candidate(s.live, target, weight, u);
    if (offer == OFFER_TAKEN) s.chosen = c.drawn;
    if (offer == OFFER_BAD) count_event(COUNTER_BAD_WEIGHT);
}

void offer(inout Stream s, LightCandidate c, uint i) {
#ifdef TARN_PLANT_SHIFT_LIGHT
    if (c.drawn.light < get_light_count()) {
        c.drawn.light = (c.drawn.light + (get_light_count() + 1u) / 2u) % get_light_count();
    }
#endif
    offer_incident(s, c, load_incident_light(c.drawn, s.receiver.point.position), i);
}

// Density with which the chosen way of selection draws `drawn`, sky and lights shared out, in the light's measure.
float selection_pdf(Stream s, LightSample drawn, IncidentLight incident) {
    if (drawn.light == LIGHT_ENVIRONMENT) {
#ifdef TARN_SELECT_UNIFORM
        return environment_pdf_solid_angle(incident.direction) / float(get_light_count() + 1u);
#else
        float share = environment_probability();
#ifdef TARN_PLANT_FORGET_SKY_SHARE
        share = 1.0f;
#endif
        return environment_pdf_solid_angle(incident.direction) * share;
#endif
    }
#if defined(TARN_SELECT_UNIFORM)
    float pmf = 1.0f / float(get_light_count() + (has_environment() ? 1u : 0u));
#elif defined(TARN_SELECT_TREE)
    float pmf = light_tree_pmf(drawn.light, s.receiver.point.position, s.receiver.point.shading_normal) *
                (1.0f - environment_probability());
#else
    float pmf =
        unpack_alias_bucket(fetch_light_alias_row(drawn.light)).pmf_own * (1.0f - environment_probability());
#endif
    return ratio_or_zero(pmf, triangle_area(load_light(drawn.light)));
}

#ifdef TARN_SELECT_UNIFORM
void offer_all(inout Stream s) {
    for (uint i = 0u; i < candidate_count; ++i) {
        offer(s, draw_light_uniformly(random_bits4(s.key, sample_dimension(DIMENSION_CANDIDATE + i))), i);
    }
}
#else
// How many candidates go to the sky: its share, rounded up or down at random, pixel by pixel: one decision for a whole
// frame would make the frame all sky or none where there is one candidate. Each kind of light has a loop of its own,
// since a software GPU runs both sides of a branch.
uint sky_candidate_count(Stream s) {
    RandomKey key = s.key;
#ifdef TARN_PLANT_SKY_PER_FRAME
    key.pixel = 0u;
#endif
    float shift = random4(key, sample_dimension(DIMENSION_SELECT)).x;
    return min(candidate_count, uint(floor(float(candidate_count) * environment_probability() + shift)));
}

void offer_light(inout Stream s, uint i, float share) {
#if defined(TARN_SELECT_TILES)
    IncidentLight incident;
    LightCandidate c = load_tile_candidate(s.window, i, s.receiver.point.position, incident);
    c.pdf *= share;
    offer_incident(s, c, incident, i);
#elif defined(TARN_SELECT_TREE)
    uvec4 bits = random_bits4(s.key, sample_dimension(DIMENSION_CANDIDATE + i));
    LightCandidate c = draw_light_by_tree(bits, s.receiver.point.position, s.receiver.point.shading_normal);
    c.pdf *= share;
    if (c.pdf > 0.0f) offer(s, c, i);
#else
    LightCandidate c = draw_light_by_power(random_bits4(s.key, sample_dimension(DIMENSION_CANDIDATE + i)));
    c.pdf *= share;
    offer(s, c, i);
#endif
}

void offer_all(inout Stream s) {
    float share = environment_probability();
    uint sky_count = SCENE_HAS_ENVIRONMENT ? sky_candidate_count(s) : 0u;
    if (SCENE_HAS_ENVIRONMENT) {
        for (uint i = 0u; i < sky_count; ++i) {
            LightCandidate c =
                draw_environment(random_bits4(s.key, sample_dimension(DIMENSION_CANDIDATE + i)));
            c.pdf *= share;
            offer(s, c, i);
        }
    }
    if (get_light_count() > 0u) {
#ifdef TARN_SELECT_TILES
        // By the number of its first candidate, which no candidate of the sky has.
        uvec4 bits = random_bits4(s.key, sample_dimension(DIMENSION_CANDIDATE + sky_count));
        s.window = find_tile_window(s.pixel, bits.x);
#endif
        for (uint i = sky_count; i < candidate_count; ++i) offer_light(s, i, 1.0f - share);
    }
}
#endif

#ifdef TARN_BRDF_CANDIDATE
// The light that the ray along the BRDF's direction met, one candidate more.
void offer_brdf_candidate(inout Stream s) {
    int row = int(pixel_index(s.pixel) * HIT_ROWS);
    LightCandidate c;
    c.drawn = find_light_sample(unpack_hit(texelFetch(brdf_hits, row), texelFetch(brdf_hits, row + 1)));
    if (c.drawn.light == INVALID_INDEX) return;
    IncidentLight incident = load_incident_light(c.drawn, s.receiver.point.position);
    c.pdf = selection_pdf(s, c.drawn, incident);
#ifdef TARN_PLANT_FORGET_LIGHT_PDF
    c.pdf = 0.0f;
#endif
    offer_incident(s, c, incident, candidate_count);
}
#endif

void main() {
    Stream s;
    s.pixel = ivec2(gl_GlobalInvocationID.xy);
    if (is_outside(s.pixel)) return;
    if (!load_receiver(s.pixel, s.receiver)) {
        store(pixel_index(s.pixel), no_light_sample(), empty_reservoir(), inactive_ray());
        return;
    }
    s.key = pixel_key(s.pixel);
    s.chosen = no_light_sample();
    s.live = empty_live_reservoir();
    offer_all(s);
    float confidence = float(candidate_count);
#ifdef TARN_BRDF_CANDIDATE
    offer_brdf_candidate(s);
    confidence += 1.0f;
#endif
    Reservoir reservoir = finish_reservoir(s.live, confidence);
    if (has_overflown(s.live)) count_event(COUNTER_BAD_RESERVOIR);
    RayRecord ray = inactive_ray();
    if (reservoir.contribution_weight > 0.0f) {
        ray = sample_ray(s.receiver, s.chosen, s.pixel);
    } else {
        s.chosen = no_light_sample();
    }
    store(pixel_index(s.pixel), s.chosen, reservoir, ray);
}
