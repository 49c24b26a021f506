// Reuse over time: this pixel's fresh sample and the one that the same surface kept in the last frame become one.
//
// Both are techniques of the same integral. The previous sample is moved here by a shift that keeps what it is (for a
// light sample: its light and the place on it; Lin et al. 2022); its density is that of the last frame's receiver in the
// last frame's scene, so that lights may move, dim, come and go. Confidence of the history is capped, or it would outvote
// the present for ever.
#include "lib/reuse/merge.glsl"

layout(binding = UNIT_PASS_C) uniform usamplerBuffer previous_reservoirs;

// The rays of a pixel: from here to the previous sample, from the previous receiver to the fresh one.
const uint RAY_HERE = 0u;
const uint RAY_PREVIOUS_RECEIVER = 1u;
// Behind these, from slot `carried_rays` on, those that ask whether the light that samples carry still reaches them: the
// previous sample in the present, the fresh one in the last frame.
const uint CARRIED_HERE = 0u;
const uint CARRIED_IN_PREVIOUS = 1u;

// The two techniques.
struct Pair {
    Receiver here;
    Receiver previous_receiver;
    ivec2 previous_pixel;
    SampleReservoir fresh;
    SampleReservoir previous;  // its sample moved to the present
    float previous_jacobian;   // of that move
    SAMPLE fresh_in_previous;  // the fresh sample moved to the last frame
    float fresh_jacobian;      // of the move back, at the fresh sample
};

// p-hat at both samples, of this pixel and of the previous receiver, visibility included where the mode asks for it. The
// previous receiver's is a density in the present: its target over the Jacobian of the move.
struct PairTargets {
    float here_at_fresh;
    float here_at_previous;
    float previous_at_fresh;
    float previous_at_previous;
};

// ---- The pixel of the last frame

// Pixels of a 4 x 4 block trade places, alike for all pixels of a frame: reuse of the very same sample by neighbours
// becomes less likely.
ivec2 permuted(ivec2 pixel) {
    RandomKey key;
    key.pixel = 0u;
    key.frame = frame_size.z;
    key.seed = frame_size.w;
    uvec4 bits = random_bits4(key, TEMPORAL_DIMENSION);
    ivec2 offset = ivec2(bits.xy & 3u);
    return ((pixel + offset) ^ ivec2(3)) - offset;
}

bool is_inside(ivec2 pixel) {
    return all(greaterThanEqual(pixel, ivec2(0))) && all(lessThan(pixel, ivec2(frame_size.xy)));
}

// How well a surface of the last frame stands for `expected`: the cosine between their normals; below 0 where it does not
// at all.
float previous_likeness(Look expected, PreviousLayers layers) {
    Look found = look_of_layers(layers.position, layers.normals, layers.diffuse);
    bool lit = was_lit(layers);
    float depth = view_depth(previous_camera(), expected.position);
    if (!lit || !is_similar(expected, found, depth) || !can_share(expected.alpha, found.alpha)) return -1.0f;
    return dot(expected.shading_normal, found.shading_normal);
}

// The pixel of the last frame that showed this surface, or of the eight around it the one whose normal is most like this
// one's. A surface never falls on the same pixel centres twice, and where a normal map is finer than pixels the nearest
// one may look another way: its history would estimate another integral, and 20 frames of that add up. Surfaces alone
// decide, so this adds no bias; but neighbours may find the same pixel and share its sample.
bool find_previous_pixel(ivec2 pixel, Receiver here, out ivec2 found, out PreviousLayers layers) {
    Look expected = look_of(here.point);
    expected.position = previous_position(pixel);
    found = project_to_previous(expected.position);
    if (found.x < 0) return false;
    if (permute != 0u) {
        ivec2 moved = permuted(found);
        found = is_inside(moved) ? moved : found;
    }
    const float GOOD_ENOUGH = 0.9999f;
    layers = load_previous_layers(found);
    float best = previous_likeness(expected, layers);
    ivec2 centre = found;
#ifdef TARN_PLANT_PREVIOUS_NORMAL
    if (best >= 0.0f)
        return true;  // the search would hide the bug: normals that are alike are hard to mistake
#endif
    for (int i = 0; i < 8 && best < GOOD_ENOUGH; ++i) {
        int place = i < 4 ? i : i + 1;  // the centre was asked
        ivec2 candidate = centre + ivec2(place % 3, place / 3) - 1;
        if (!is_inside(candidate)) continue;
        PreviousLayers theirs = load_previous_layers(candidate);
        float likeness = previous_likeness(expected, theirs);
        if (likeness > best) {
            best = likeness;
            found = candidate;
            layers = theirs;
        }
    }
    return best >= 0.0f;
}

// ---- The two techniques

// The last frame's reservoir as this frame may use it.
SampleReservoir load_previous_reservoir(ivec2 pixel, float fresh_confidence) {
    SampleReservoir previous = load_reservoir(previous_reservoirs, pixel);
    previous.state.age += 1.0f;
#ifdef TARN_PLANT_NAN_HISTORY
    if (frame_size.z % 4u == 2u && (pixel.x + pixel.y) % 4 == 0) {
        previous.state.contribution_weight = uintBitsToFloat(0x7fc00000u);
    }
#endif
    bool stale = age_cap > 0.0f && previous.state.age > age_cap;
    if (!is_finite(previous.state.contribution_weight) || !is_finite(previous.state.confidence)) {
        count_event(COUNTER_BAD_HISTORY);
        stale = true;
    }
    if (stale) return empty_sample_reservoir();
    previous.state.confidence = min(previous.state.confidence, confidence_cap * fresh_confidence);
    return previous;
}

Pair make_pair(Receiver here, SampleReservoir fresh, ivec2 previous_pixel, PreviousLayers layers) {
    Pair p;
    p.here = here;
    p.fresh = fresh;
    p.previous_pixel = previous_pixel;
    p.previous_receiver = load_previous_receiver(previous_pixel, layers);
    p.previous = load_previous_reservoir(previous_pixel, fresh.state.confidence);
    SAMPLE in_previous = p.previous.chosen;
    p.previous.chosen = move_to_present(in_previous);
    p.previous_jacobian = temporal_jacobian(p.previous_receiver, here, p.previous.chosen, in_previous);
    // What the sample lies on is no more: the sample goes, the confidence of the history stays.
    if (!is_sample(p.previous.chosen)) p.previous.state.contribution_weight = 0.0f;
    p.fresh_in_previous = move_to_previous(fresh.chosen);
    p.fresh_jacobian = temporal_jacobian(p.previous_receiver, here, fresh.chosen, p.fresh_in_previous);
#ifdef TARN_PLANT_DROP_PREVIOUS_JACOBIAN
    p.previous_jacobian = 1.0f;
#endif
#ifdef TARN_PLANT_DROP_FRESH_JACOBIAN
    p.fresh_jacobian = 1.0f;
#endif
    return p;
}

float find_previous_at_fresh(Pair p) {
    if (!is_sample(p.fresh_in_previous)) return 0.0f;
    return ratio_or_zero(previous_sample_target(p.previous_receiver, p.fresh_in_previous), p.fresh_jacobian);
}

// Whether the light that a sample carries reaches it, where this frame asks. Where the weights know all visibility a
// sample that cannot be asked is none: its technique ends with the frame that changed something.
float find_carried(SAMPLE drawn, ivec2 pixel, uint slot) {
#if defined(TARN_CARRIED_LIGHT) && !defined(TARN_PLANT_TRUST_CARRIED_LIGHT)
    if (carried_rays == INVALID_INDEX) return 1.0f;
    if (!can_ask_for_carried(drawn)) return MIS_VISIBILITY ? 0.0f : 1.0f;
    return load_answer(pixel, carried_rays + slot);
#else
    return 1.0f;
#endif
}

PairTargets find_targets(Pair p, ivec2 pixel) {
    bool has_fresh = holds_sample(p.fresh);
    bool has_previous = holds_sample(p.previous);
    PairTargets t;
    t.here_at_fresh = has_fresh ? p.fresh.state.target : 0.0f;
    t.here_at_previous = has_previous ? sample_target(p.here, p.previous.chosen) : 0.0f;
    t.previous_at_fresh = has_fresh ? find_previous_at_fresh(p) : 0.0f;
    t.previous_at_previous =
        has_previous ? ratio_or_zero(p.previous.state.target, p.previous_jacobian) : 0.0f;
    if (MIS_VISIBILITY) {
        t.here_at_previous *= load_answer(pixel, RAY_HERE);
        t.previous_at_fresh *= load_answer(pixel, RAY_PREVIOUS_RECEIVER);
    }
    t.here_at_previous *= find_carried(p.previous.chosen, pixel, CARRIED_HERE);
    t.previous_at_fresh *= find_carried(p.fresh_in_previous, pixel, CARRIED_IN_PREVIOUS);
    return t;
}

// ---- Weights

// m of the two samples; those of 1/M and 1/Z are not yet divided.
void weigh(Pair p, PairTargets t, out float fresh_weight, out float previous_weight) {
    float fresh_confidence = p.fresh.state.confidence;
    float previous_confidence = p.previous.state.confidence;
    float own_confidence = previous_confidence;
#ifdef TARN_PLANT_SKIP_CONFIDENCE
    own_confidence = 1.0f;
#endif
    if (MIS == MIS_BALANCE) {
        float fresh_term = balance_term(fresh_confidence, t.here_at_fresh);
        fresh_weight =
            bounded_ratio(fresh_term, fresh_term + balance_term(previous_confidence, t.previous_at_fresh));
        float previous_term = balance_term(previous_confidence, t.previous_at_previous);
        previous_weight = bounded_ratio(balance_term(own_confidence, t.previous_at_previous),
                                        previous_term + balance_term(fresh_confidence, t.here_at_previous));
    } else if (MIS == MIS_PAIRWISE) {
        PairwiseStep step = PairwiseStep(fresh_confidence, previous_confidence);
        fresh_weight =
            pairwise_defensive_share(step) +
            pairwise_canonical_term(step, previous_confidence, t.previous_at_fresh, t.here_at_fresh);
        previous_weight =
            pairwise_neighbour_weight(step, own_confidence, t.previous_at_previous, t.here_at_previous);
    } else {
        fresh_weight = fresh_confidence;
        previous_weight = own_confidence;
    }
#ifdef TARN_PLANT_DROP_NORMALIZATION
    if (WEIGHTS_SUM_TO_ONE) {
        fresh_weight = 1.0f;
        previous_weight = 1.0f;
    }
#endif
}

// What 1/M and 1/Z divide by: all techniques, or those that could have made the chosen sample.
float find_normalization(Pair p, PairTargets t, bool previous_leads) {
    float fresh_confidence = p.fresh.state.confidence;
    float previous_confidence = p.previous.state.confidence;
    if (MIS == MIS_ONE_OVER_M) return fresh_confidence + previous_confidence;
    if (MIS != MIS_ONE_OVER_Z) return 1.0f;
    return previous_leads
               ? z_term(fresh_confidence, t.here_at_previous) +
                     z_term(previous_confidence, t.previous_at_previous)
               : z_term(fresh_confidence, t.here_at_fresh) + z_term(previous_confidence, t.previous_at_fresh);
}

#ifdef TARN_CHECK_MIS
// The weights of both techniques at the previous sample sum to 1. The previous technique's density there is found twice:
// as the merge has it, from what the last frame stored, and as for a fresh sample at that place, by the way back.
void check_weights(Pair p, PairTargets t) {
    if (!WEIGHTS_SUM_TO_ONE || t.here_at_previous == 0.0f) return;
    p.fresh_in_previous = move_to_previous(p.previous.chosen);
    p.fresh_jacobian = temporal_jacobian(p.previous_receiver, p.here, p.previous.chosen, p.fresh_in_previous);
#ifdef TARN_PLANT_DROP_FRESH_JACOBIAN
    p.fresh_jacobian = 1.0f;
#endif
    float fresh_weight, previous_weight;
    t.here_at_fresh = t.here_at_previous;
    t.previous_at_fresh = find_previous_at_fresh(p);
    weigh(p, t, fresh_weight, previous_weight);
    if (abs(fresh_weight + previous_weight - 1.0f) > 1e-3f) count_event(COUNTER_MIS_SUM);
}
#endif

// ---- The step

SampleReservoir merge(Pair p, ivec2 pixel) {
    PairTargets t = find_targets(p, pixel);
#ifdef TARN_CHECK_MIS
    check_weights(p, t);
#endif
    float fresh_weight, previous_weight;
    weigh(p, t, fresh_weight, previous_weight);

    Merge m = empty_merge();
    vec4 u = random4(pixel_key(pixel), TEMPORAL_DIMENSION);
    float fresh_offer = fresh_weight * t.here_at_fresh * p.fresh.state.contribution_weight;
    float previous_offer =
        previous_weight * t.here_at_previous * p.previous.state.contribution_weight * p.previous_jacobian;
#ifdef TARN_PLANT_TARGET_AT_NEIGHBOUR
    if (t.here_at_previous > 0.0f) previous_offer *= t.previous_at_previous / t.here_at_previous;
#endif
#ifdef TARN_PLANT_PREVIOUS_NORMAL
    Receiver mixed_up = make_receiver(p.here.point, from_local(p.here.frame, p.here.brdf.view));
    mixed_up.frame = p.previous_receiver.frame;
    if (t.here_at_previous > 0.0f) {
        previous_offer *= sample_target(mixed_up, p.previous.chosen) / t.here_at_previous;
    }
#endif
    offer_merged(m, p.fresh, t.here_at_fresh, fresh_offer, u.x);
    bool previous_leads = offer_merged(m, p.previous, t.here_at_previous, previous_offer, u.y);
    return finish_merge(m, p.fresh.state.confidence + p.previous.state.confidence,
                        find_normalization(p, t, previous_leads));
}

void write_carried_rays(Pair p, ivec2 pixel) {
#ifdef TARN_CARRIED_LIGHT
    if (carried_rays == INVALID_INDEX) return;
    RayRecord here = inactive_ray();
    RayRecord in_previous = inactive_ray();
    if (holds_sample(p.previous)) here = carried_ray(p.previous.chosen, pixel);
    if (holds_sample(p.fresh) && is_sample(p.fresh_in_previous)) {
        in_previous = previous_carried_ray(p.fresh_in_previous, p.previous_pixel);
    }
    store_ray(pixel, carried_rays + CARRIED_HERE, here);
    store_ray(pixel, carried_rays + CARRIED_IN_PREVIOUS, in_previous);
#endif
}

void write_rays(Pair p, ivec2 pixel) {
    write_carried_rays(p, pixel);
    if (!MIS_VISIBILITY) return;
    RayRecord from_here = inactive_ray();
    RayRecord from_previous = inactive_ray();
    if (holds_sample(p.previous)) from_here = sample_ray(p.here, p.previous.chosen, pixel);
    if (holds_sample(p.fresh) && is_sample(p.fresh_in_previous)) {
        from_previous = previous_sample_ray(p.previous_receiver, p.fresh_in_previous, p.previous_pixel);
    }
    store_ray(pixel, RAY_HERE, from_here);
    store_ray(pixel, RAY_PREVIOUS_RECEIVER, from_previous);
}

void main() {
    ivec2 pixel = band_pixel();
    if (is_outside_band(pixel)) return;
    Receiver here;
    bool lit = load_receiver(pixel, here);
    SampleReservoir fresh = load_reservoir(in_reservoirs, pixel);
    ivec2 previous_pixel = ivec2(-1);
    PreviousLayers layers;
    bool has_pair = lit && find_previous_pixel(pixel, here, previous_pixel, layers);
#ifdef TARN_WRITE_RAYS
    if (has_pair) {
        write_rays(make_pair(here, fresh, previous_pixel, layers), pixel);
    } else {
        store_no_rays(pixel);
    }
#else
    SampleReservoir result = fresh;
    if (has_pair) result = merge(make_pair(here, fresh, previous_pixel, layers), pixel);
#ifdef TARN_PLANT_COUNT_DEAD
    if (!has_pair) result.state.confidence += confidence_cap * fresh.state.confidence;
    if (!has_pair) result.state.contribution_weight /= 1.0f + confidence_cap;
#endif
    store_reservoir(pixel, here, result);
#endif
}
