// Reuse over time: this pixel's fresh sample and the one that the same surface kept in the last frame become one.
//
// Both are techniques of the same integral. The past one is moved here by a shift that keeps light and place on it
// (Lin et al. 2022); its density is that of the last frame's receiver under the last frame's lights, so that lights may
// move, dim, come and go. Confidence of the past is capped, or history would outvote the present for ever.
#include "lib/scene_buffers.glsl"
#include "lib/frame.glsl"
#include "lib/gbuffer.glsl"
#include "lib/counters.glsl"
#include "lib/receiver.glsl"
#include "lib/past.glsl"
#include "lib/neighbour_test.glsl"
#include "lib/reuse.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

layout(binding = UNIT_PASS_C) uniform usamplerBuffer past_reservoirs;

uniform uint has_past;         // 0: the last frame left nothing that this one can use
uniform float confidence_cap;  // of the past, as a multiple of the fresh sample's
uniform float age_cap;         // frames after which a sample is dropped; 0: never
uniform uint permute;          // 1: neighbours of a pixel swap their histories

// The rays of a pixel: from here to the past sample, from the past receiver to the fresh one.
const uint RAY_HERE = 0u;
const uint RAY_THERE = 1u;

struct Pair {
    Receiver here;
    Receiver there;
    ivec2 there_pixel;
    Reservoir fresh;
    Reservoir past;          // its sample moved to the present
    float past_jacobian;     // of that move
    LightSample fresh_there;  // the fresh sample moved to the past
    float fresh_jacobian;     // of the same move, at the fresh sample: from fresh_there to the present
};

// Pixels of a 4 x 4 block trade places, alike for all pixels of a frame: reuse of the very same sample by neighbours
// becomes less likely.
ivec2 permuted(ivec2 pixel) {
    RandomKey key;
    key.pixel = 0u;
    key.frame = frame_size.z;
    key.seed = frame_size.w;
    uvec4 bits = random_bits4(key, DIMENSION_TEMPORAL);
    ivec2 offset = ivec2(bits.xy & 3u);
    return ((pixel + offset) ^ ivec2(3)) - offset;
}

bool is_inside(ivec2 pixel) {
    return all(greaterThanEqual(pixel, ivec2(0))) && all(lessThan(pixel, ivec2(frame_size.xy)));
}

// How similar the last frame's surface at `pixel` is to `expected`: the cosine between their normals; below 0 where it is
// another surface.
float past_likeness(Look expected, ivec2 pixel) {
    vec4 position = texelFetch(previous_layers, ivec3(pixel, LAYER_POSITION), 0);
    Look found = look_of_layers(position, texelFetch(previous_layers, ivec3(pixel, LAYER_NORMALS), 0),
                                texelFetch(previous_layers, ivec3(pixel, LAYER_DIFFUSE), 0));
    float depth = view_depth(previous_camera(), expected.position);
    if (position.w < 0.0f || !is_similar(expected, found, depth)) return -1.0f;
    return dot(expected.shading_normal, found.shading_normal);
}

// The pixel of the last frame that showed this surface, or of the eight around it the one whose normal is most like this
// one's. A surface never falls on the same pixel centres twice, and where a normal map is finer than pixels the nearest
// one may look another way: its history would estimate another integral, and 20 frames of that add up. Surfaces alone
// decide, so this adds no bias; but neighbours may find the same past and share its sample.
bool find_past_pixel(ivec2 pixel, Receiver here, out ivec2 found) {
    Look expected = look_of(here.point);
    expected.position = previous_position(pixel);
    found = project_to_previous(expected.position);
    if (has_past == 0u || found.x < 0) return false;
    if (permute != 0u) {
        ivec2 moved = permuted(found);
        found = is_inside(moved) ? moved : found;
    }
    const float GOOD_ENOUGH = 0.9999f;
    float best = past_likeness(expected, found);
    ivec2 centre = found;
#ifdef TARN_PLANT_PREVIOUS_NORMAL
    if (best >= 0.0f) return true;  // the search would hide the bug: normals that are alike are hard to mistake
#endif
    for (int i = 0; i < 9 && best < GOOD_ENOUGH; ++i) {
        ivec2 candidate = centre + ivec2(i % 3, i / 3) - 1;
        if (!is_inside(candidate)) continue;
        float likeness = past_likeness(expected, candidate);
        if (likeness > best) {
            best = likeness;
            found = candidate;
        }
    }
    return best >= 0.0f;
}

// The last frame's reservoir as this frame may use it.
Reservoir load_past(ivec2 pixel, float fresh_confidence) {
    Reservoir past = load_reservoir(past_reservoirs, pixel);
    past.age += 1.0f;
#ifdef TARN_PLANT_NAN_HISTORY
    if (frame_size.z % 4u == 2u && (pixel.x + pixel.y) % 4 == 0) past.contribution_weight = uintBitsToFloat(0x7fc00000u);
#endif
    bool stale = age_cap > 0.0f && past.age > age_cap;
    if (!is_finite(past.contribution_weight) || !is_finite(past.confidence)) {
        count_event(COUNTER_BAD_HISTORY);
        stale = true;
    }
    if (stale) return empty_reservoir();
    past.confidence = min(past.confidence, confidence_cap * fresh_confidence);
    return past;
}

Pair make_pair(Receiver here, Reservoir fresh, ivec2 there_pixel) {
    Pair p;
    p.here = here;
    p.fresh = fresh;
    p.there_pixel = there_pixel;
    load_previous_receiver(there_pixel, p.there);
    p.past = load_past(there_pixel, fresh.confidence);
    LightSample past_there = p.past.chosen;
    p.past.chosen = move_to_present(past_there);
    p.past_jacobian = shift_jacobian(p.past.chosen, past_there);
    // The light is gone: the sample is dropped, the history's confidence stays.
    if (p.past.chosen.light == INVALID_INDEX) p.past.contribution_weight = 0.0f;
    p.fresh_there = move_to_past(fresh.chosen);
    p.fresh_jacobian = shift_jacobian(fresh.chosen, p.fresh_there);
#ifdef TARN_PLANT_DROP_PAST_JACOBIAN
    p.past_jacobian = 1.0f;
#endif
#ifdef TARN_PLANT_DROP_FRESH_JACOBIAN
    p.fresh_jacobian = 1.0f;
#endif
    return p;
}

// The past technique's density at the fresh sample, moved into the present: its target there over the Jacobian of the
// move.
float there_at_fresh(Pair p) {
    if (p.fresh_there.light == INVALID_INDEX) return 0.0f;
    IncidentLight incident = load_previous_incident_light(p.fresh_there, p.there.point.position);
    return ratio_or_zero(target_at(p.there, incident), p.fresh_jacobian);
}

// Weights m of the two samples. Targets: [who][whose sample], visibility included where the mode asks.
void weigh(Pair p, float here_fresh, float here_past, float there_fresh, float there_past, out float fresh_weight,
           out float past_weight) {
    float fresh_confidence = p.fresh.confidence;
    float past_confidence = p.past.confidence;
    float past_own_confidence = past_confidence;
#ifdef TARN_PLANT_SKIP_CONFIDENCE
    past_own_confidence = 1.0f;
#endif
    if (MIS == MIS_BALANCE) {
        float ours = balance_term(fresh_confidence, here_fresh);
        fresh_weight = bounded_ratio(ours, ours + balance_term(past_confidence, there_fresh));
        float theirs = balance_term(past_confidence, there_past);
        past_weight = bounded_ratio(balance_term(past_own_confidence, there_past),
                                    theirs + balance_term(fresh_confidence, here_past));
    } else if (MIS == MIS_PAIRWISE) {
        PairwiseStep step = PairwiseStep(fresh_confidence, past_confidence);
        fresh_weight = pairwise_defensive_share(step) +
                       pairwise_canonical_term(step, past_confidence, there_fresh, here_fresh);
        past_weight = pairwise_neighbour_weight(step, past_own_confidence, there_past, here_past);
    } else {
        fresh_weight = fresh_confidence;
        past_weight = past_own_confidence;
    }
#ifdef TARN_PLANT_DROP_NORMALIZATION
    if (MIS == MIS_BALANCE || MIS == MIS_PAIRWISE) {
        fresh_weight = 1.0f;
        past_weight = 1.0f;
    }
#endif
}

// What constant and count divide by: all techniques, or those that could have made the chosen sample.
float normalization(Pair p, bool past_leads, float here_fresh, float here_past, float there_fresh, float there_past) {
    if (MIS == MIS_CONSTANT) return p.fresh.confidence + p.past.confidence;
    if (MIS != MIS_COUNT) return 1.0f;
    return past_leads ? count_term(p.fresh.confidence, here_past) + count_term(p.past.confidence, there_past)
                      : count_term(p.fresh.confidence, here_fresh) + count_term(p.past.confidence, there_fresh);
}

#ifdef TARN_CHECK_MIS
// The weights of both techniques at the past sample sum to 1. The past technique's density there is found twice: as the
// merge has it, from what the last frame stored, and as for a fresh sample at that place, by the way back.
void check_weights(Pair p, float here_past, float there_past) {
    if (MIS != MIS_BALANCE && MIS != MIS_PAIRWISE || here_past == 0.0f) return;
    p.fresh_there = move_to_past(p.past.chosen);
    p.fresh_jacobian = shift_jacobian(p.past.chosen, p.fresh_there);
#ifdef TARN_PLANT_DROP_FRESH_JACOBIAN
    p.fresh_jacobian = 1.0f;
#endif
    float fresh_weight, past_weight;
    weigh(p, here_past, here_past, there_at_fresh(p), there_past, fresh_weight, past_weight);
    if (abs(fresh_weight + past_weight - 1.0f) > 1e-3f) count_event(COUNTER_MIS_SUM);
}
#endif

Reservoir merge(Pair p, ivec2 pixel) {
    bool has_fresh = p.fresh.contribution_weight > 0.0f;
    bool has_past_sample = p.past.contribution_weight > 0.0f;
    float here_fresh = has_fresh ? p.fresh.target : 0.0f;
    float here_past = has_past_sample ? sample_target(p.here, p.past.chosen) : 0.0f;
    float there_fresh = has_fresh ? there_at_fresh(p) : 0.0f;
    float there_past = has_past_sample ? ratio_or_zero(p.past.target, p.past_jacobian) : 0.0f;
    if (MIS_VISIBILITY) {
        here_past *= load_answer(pixel, RAY_HERE);
        there_fresh *= load_answer(pixel, RAY_THERE);
    }
#ifdef TARN_CHECK_MIS
    check_weights(p, here_past, there_past);
#endif
    float fresh_weight, past_weight;
    weigh(p, here_fresh, here_past, there_fresh, there_past, fresh_weight, past_weight);

    Merge m = empty_merge();
    vec4 u = random4(pixel_key(pixel), DIMENSION_TEMPORAL);
    float fresh_offer = fresh_weight * here_fresh * p.fresh.contribution_weight;
    float past_offer = past_weight * here_past * p.past.contribution_weight * p.past_jacobian;
#ifdef TARN_PLANT_TARGET_AT_NEIGHBOUR
    if (here_past > 0.0f) past_offer *= there_past / here_past;
#endif
#ifdef TARN_PLANT_PREVIOUS_NORMAL
    Receiver mixed_up = make_receiver(p.here.point, from_local(p.here.frame, p.here.view_local));
    mixed_up.frame = p.there.frame;
    if (here_past > 0.0f) past_offer *= sample_target(mixed_up, p.past.chosen) / here_past;
#endif
    offer_merged(m, p.fresh, here_fresh, fresh_offer, u.x);
    offer_merged(m, p.past, here_past, past_offer, u.y);
    bool past_leads = m.live.target > 0.0f && past_offer > 0.0f && u.y * m.live.weight_sum < past_offer;
    return finish_merge(m, p.fresh.confidence + p.past.confidence,
                        normalization(p, past_leads, here_fresh, here_past, there_fresh, there_past));
}

void write_rays(Pair p, ivec2 pixel) {
    RayRecord from_here = inactive_ray();
    RayRecord from_there = inactive_ray();
    if (p.past.contribution_weight > 0.0f) from_here = sample_ray(p.here, p.past.chosen, pixel);
    if (p.fresh.contribution_weight > 0.0f && p.fresh_there.light != INVALID_INDEX) {
        // A ray of the last frame: to where the light was, past what stood in its way then.
        IncidentLight incident = load_previous_incident_light(p.fresh_there, p.there.point.position);
        if (max_component(incident.value) > 0.0f) {
            from_there = make_shadow_ray(p.there.point, incident, load_previous_light_error(p.fresh_there),
                                         pixel_index(p.there_pixel));
#ifndef TARN_PLANT_PRESENT_GEOMETRY
            from_there.pixel |= RAY_PREVIOUS;
#endif
        }
    }
    store_ray(pixel, RAY_HERE, from_here);
    store_ray(pixel, RAY_THERE, from_there);
}

void main() {
    ivec2 pixel = band_pixel();
    if (is_outside_band(pixel)) return;
    Receiver here;
    bool lit = load_receiver(pixel, here);
    Reservoir fresh = load_reservoir(in_reservoirs, pixel);
    ivec2 there_pixel = ivec2(-1);
    bool has_pair = lit && find_past_pixel(pixel, here, there_pixel);
#ifdef TARN_WRITE_RAYS
    if (has_pair) {
        write_rays(make_pair(here, fresh, there_pixel), pixel);
    } else {
        store_no_rays(pixel);
    }
#else
    Reservoir result = fresh;
    if (has_pair) {
        Pair pair = make_pair(here, fresh, there_pixel);
        result = merge(pair, pixel);
    }
#ifdef TARN_PLANT_COUNT_DEAD
    if (!has_pair) result.confidence += confidence_cap * fresh.confidence;
    if (!has_pair) result.contribution_weight /= 1.0f + confidence_cap;
#endif
    store_reservoir(pixel, here, result);
#endif
}
