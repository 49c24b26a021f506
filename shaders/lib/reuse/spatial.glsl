// Reuse over space: this pixel's sample and those of some neighbours become one.
//
// Technique 0 is the pixel itself, 1 .. NEIGHBOURS are pixels drawn at random within a radius; those that are outside of
// the picture or show another surface are left out and are no techniques. How the samples are weighed, TARN_MIS says
// (shared/math/mis.h). Densities are those of the pixel's domain: a technique's own target times the Jacobian of the
// shift from the pixel to it.
#include "lib/reuse/merge.glsl"

const uint NEIGHBOURS = TARN_NEIGHBOURS;  // 1 .. 9

#ifdef TARN_SHADE_ALL
// Where all samples of this step light the pixel: the sum of m x BRDF x Le x G x visibility x W over them.
layout(binding = 0, rgba32f) uniform writeonly image2D diffuse_image;  // without the albedo
layout(binding = 1, rgba32f) uniform writeonly image2D specular_image;
#endif

// The pixel and who joins it.
struct Gathering {
    ivec2 pixel;
    Receiver here;
    SampleReservoir canonical;
    uint joined;  // bit n: neighbour n is a technique
    float neighbour_confidence;
};

vec4 neighbour_random(ivec2 pixel, uint n) {
    return random4(pixel_key(pixel), SPATIAL_DIMENSION + 16u * iteration + n);
}

ivec2 mirrored(ivec2 pixel) {
    ivec2 last = ivec2(frame_size.xy) - 1;
    pixel = abs(pixel);
    return last - abs(last - pixel);
}

// Uniform in the disc.
ivec2 neighbour_pixel(ivec2 pixel, uint n) {
    vec4 u = neighbour_random(pixel, n);
    float angle = 2.0f * PI * u.x;
    ivec2 found = pixel + ivec2(round(vec2(cos(angle), sin(angle)) * (radius_px * sqrt(u.y))));
    return mirror != 0u ? mirrored(found) : found;
}

ivec2 technique_pixel(Gathering g, uint t) { return t == 0u ? g.pixel : neighbour_pixel(g.pixel, t); }

bool has_joined(Gathering g, uint t) { return t == 0u || (g.joined & (1u << t)) != 0u; }

bool can_join(Receiver here, ivec2 pixel, ivec2 neighbour) {
    if (any(lessThan(neighbour, ivec2(0))) || any(greaterThanEqual(neighbour, ivec2(frame_size.xy))))
        return false;
    if (neighbour == pixel) return false;
    vec4 position = load_layer(neighbour, LAYER_POSITION);
    Look look =
        look_of_layers(position, load_layer(neighbour, LAYER_NORMALS), load_layer(neighbour, LAYER_DIFFUSE));
    Look own = look_of(here.point);
    // 1/Z gives all who could have made a sample the same share of it, however rarely they do: a mirror's energy would
    // hang on samples that no run meets. Balance and pairwise know how likely each is.
#ifndef TARN_PLANT_COUNT_MIRRORS
    if (MIS == MIS_ONE_OVER_Z && is_mirror_like(look, own)) return false;
#endif
    if (!can_share(look.alpha, own.alpha)) return false;
    return position.w >= 0.0f && is_similar(look, own, view_depth(frame_camera(), here.point.position));
}

Gathering gather(ivec2 pixel, Receiver here) {
    Gathering g;
    g.pixel = pixel;
    g.here = here;
    g.canonical = load_reservoir(in_reservoirs, pixel);
    g.joined = 0u;
    g.neighbour_confidence = 0.0f;
    for (uint n = 1u; n <= NEIGHBOURS; ++n) {
        ivec2 neighbour = neighbour_pixel(pixel, n);
        bool joins = can_join(here, pixel, neighbour);
        g.joined |= joins ? 1u << n : 0u;
        float confidence = joins ? load_confidence(in_reservoirs, neighbour) : 0.0f;
#ifdef TARN_PLANT_COUNT_DEAD
        if (!joins) confidence = g.canonical.state.confidence;
#endif
        g.neighbour_confidence += confidence;
    }
    return g;
}

// The sample of technique `t`; nothing where it did not join.
SampleReservoir technique_reservoir(Gathering g, uint t) {
    if (t == 0u) return g.canonical;
    if (!has_joined(g, t)) return empty_sample_reservoir();
    return load_reservoir(in_reservoirs, technique_pixel(g, t));
}

float technique_confidence(Gathering g, uint t) {
    return t == 0u ? g.canonical.state.confidence : load_confidence(in_reservoirs, technique_pixel(g, t));
}

Receiver technique_receiver(Gathering g, uint t) {
    if (t == 0u) return g.here;
    Receiver r;
    load_receiver(technique_pixel(g, t), r);
    return r;
}

// Whether technique `t` sees the sample of technique `sampled`, where the mode asks.
float answer(Gathering g, uint sampled, uint t) {
    if (!MIS_VISIBILITY || sampled == t) return 1.0f;
    return load_answer(g.pixel, technique_ray_slot(MIS, NEIGHBOURS, sampled, t));
}

// p-hat of technique `t` at a sample, in the pixel's domain and without visibility.
float technique_target(Gathering g, uint t, SAMPLE drawn) {
    if (t == 0u) return sample_target(g.here, drawn);
    Receiver r = technique_receiver(g, t);
    return sample_target(r, drawn) * shift_jacobian(g.here, r, drawn);
}

// The same at its own sample, whose target it stored.
float own_target(Gathering g, uint t, SampleReservoir r) {
    if (t == 0u) return r.state.target;
    return r.state.target * shift_jacobian(g.here, technique_receiver(g, t), r.chosen);
}

// W of its own sample in the pixel's domain.
float own_contribution_weight(Gathering g, uint t, SampleReservoir r) {
    if (t == 0u) return r.state.contribution_weight;
    return r.state.contribution_weight * shift_jacobian(technique_receiver(g, t), g.here, r.chosen);
}

// ---- Balance: every technique looks at every sample.

// Over all techniques, for the sample `r` of technique `sampled`.
float balance_sum(Gathering g, uint sampled, SampleReservoir r) {
    float sum = balance_term(technique_confidence(g, sampled), own_target(g, sampled, r));
    for (uint t = 0u; t <= NEIGHBOURS; ++t) {
        if (t == sampled || !has_joined(g, t)) continue;
        sum += balance_term(technique_confidence(g, t),
                            technique_target(g, t, r.chosen) * answer(g, sampled, t));
    }
    return sum;
}

// ---- Pairwise: each neighbour looks at the pixel's sample, the pixel at each neighbour's.

PairwiseStep pairwise_step(Gathering g) {
    return PairwiseStep(g.canonical.state.confidence, g.neighbour_confidence);
}

float pairwise_canonical_weight(Gathering g) {
    PairwiseStep step = pairwise_step(g);
    float weight = pairwise_defensive_share(step);
    for (uint n = 1u; n <= NEIGHBOURS; ++n) {
        if (!has_joined(g, n)) continue;
        float target = technique_target(g, n, g.canonical.chosen) * answer(g, 0u, n);
        weight += pairwise_canonical_term(step, technique_confidence(g, n), target, g.canonical.state.target);
    }
    return weight;
}

// ---- All modes

// m of technique `t` for its own sample; those of 1/M and 1/Z are divided at the end.
float technique_weight(Gathering g, uint t, SampleReservoir r, float target_here) {
    float confidence = technique_confidence(g, t);
#ifdef TARN_PLANT_SKIP_CONFIDENCE
    confidence = 1.0f;
#endif
#ifdef TARN_PLANT_DROP_NORMALIZATION
    return WEIGHTS_SUM_TO_ONE ? 1.0f : confidence;
#endif
    if (MIS == MIS_BALANCE)
        return bounded_ratio(balance_term(confidence, own_target(g, t, r)), balance_sum(g, t, r));
    if (MIS == MIS_PAIRWISE) {
        if (t == 0u) return pairwise_canonical_weight(g);
        return pairwise_neighbour_weight(pairwise_step(g), confidence, own_target(g, t, r), target_here);
    }
    return confidence;
}

// p-hat here at the sample of technique `t`, with visibility where the mode resamples by it.
float find_target_here(Gathering g, uint t, SampleReservoir r) {
    if (t == 0u) return r.state.target;
    float target = sample_target(g.here, r.chosen);
    if (WEIGHTS_SUM_TO_ONE) target *= answer(g, t, 0u);
    return target;
}

// Z, or M.
float find_normalization(Gathering g, Merge m) {
    if (MIS == MIS_ONE_OVER_M) return g.canonical.state.confidence + g.neighbour_confidence;
    if (MIS != MIS_ONE_OVER_Z) return 1.0f;
    float z = 0.0f;
    for (uint t = 0u; t <= NEIGHBOURS; ++t) {
        if (!has_joined(g, t)) continue;
        float target = technique_target(g, t, m.chosen);
        if (MIS_VISIBILITY) target *= load_answer(g.pixel, t);
        z += z_term(technique_confidence(g, t), target);
    }
    return z;
}

// What a sample sends to the viewer, `share` being its m x W. Its colour is its own: averaging visibility under one
// chosen colour leaks, this does not.
void shade_sample(Gathering g, SampleReservoir r, float share, inout BrdfValue light) {
    float factor = share * (MIS_VISIBILITY ? 1.0f : r.state.visibility);
    BrdfValue reflected = reflect_sample(g.here, r.chosen);
    light.diffuse += reflected.diffuse * factor;
    light.specular += reflected.specular * factor;
}

Merge merge_all(Gathering g, out BrdfValue light) {
    Merge m = empty_merge();
    light = no_reflection();
    for (uint t = 0u; t <= NEIGHBOURS; ++t) {
        SampleReservoir r = technique_reservoir(g, t);
        if (r.state.contribution_weight == 0.0f) continue;
        float target = find_target_here(g, t, r);
#ifndef TARN_WRITE_RAYS
        if (VISIBILITY_IS_KNOWN && t > 0u && !MIS_VISIBILITY) {
            r.state.visibility = load_answer(g.pixel, canonical_ray_slot(MIS, false, NEIGHBOURS, t));
        }
#endif
        float weight = technique_weight(g, t, r, target) * target * own_contribution_weight(g, t, r);
#ifdef TARN_PLANT_TARGET_AT_NEIGHBOUR
        if (target > 0.0f) weight *= r.state.target / target;
#endif
        offer_merged(m, r, target, weight, neighbour_random(g.pixel, t).z);
#ifdef TARN_SHADE_ALL
        if (weight > 0.0f && is_finite(weight)) shade_sample(g, r, weight / target, light);
#endif
    }
    return m;
}

SampleReservoir finish(Gathering g, Merge m) {
    SampleReservoir result =
        finish_merge(m, g.canonical.state.confidence + g.neighbour_confidence, find_normalization(g, m));
    // 1/Z resamples without visibility: a sample that this pixel does not see ends here.
    if (MIS == MIS_ONE_OVER_Z && MIS_VISIBILITY && load_answer(g.pixel, 0u) == 0.0f) {
        result.state.contribution_weight = 0.0f;
    }
    return result;
}

#ifdef TARN_CHECK_MIS
// The weights of all techniques at each sample sum to 1; a debugging aid, quadratic in the techniques.
void check_weights(Gathering g) {
    if (!WEIGHTS_SUM_TO_ONE) return;
    for (uint sampled = 0u; sampled <= NEIGHBOURS; ++sampled) {
        SampleReservoir r = technique_reservoir(g, sampled);
        float here = find_target_here(g, sampled, r);
        if (!holds_sample(r) || here == 0.0f) continue;
        float sum = MIS == MIS_PAIRWISE ? pairwise_defensive_share(pairwise_step(g)) : 0.0f;
        for (uint t = 0u; t <= NEIGHBOURS; ++t) {
            if (!has_joined(g, t)) continue;
            float target = t == sampled ? own_target(g, t, r) : technique_target(g, t, r.chosen);
            if (MIS == MIS_BALANCE) {
                target *= answer(g, sampled, t);
                sum += bounded_ratio(balance_term(technique_confidence(g, t), target),
                                     balance_sum(g, sampled, r));
            } else if (t > 0u) {
                PairwiseStep step = pairwise_step(g);
                sum += pairwise_neighbour_weight(step, technique_confidence(g, t), target, here) +
                       pairwise_canonical_term(step, technique_confidence(g, t), target, here);
            }
        }
        if (abs(sum - 1.0f) > 1e-5f) count_event(COUNTER_MIS_SUM);
    }
}
#endif

void write_ray(Gathering g, uint t, SAMPLE drawn, uint slot) {
    store_ray(g.pixel, slot, sample_ray(technique_receiver(g, t), drawn, technique_pixel(g, t)));
}

void write_rays(Gathering g) {
    store_no_rays(g.pixel);
    if (MIS == MIS_ONE_OVER_Z && MIS_VISIBILITY) {
        BrdfValue light;
        SAMPLE chosen = merge_all(g, light).chosen;
        for (uint t = 0u; t <= NEIGHBOURS; ++t) {
            if (has_joined(g, t)) write_ray(g, t, chosen, t);
        }
        return;
    }
    for (uint sampled = 0u; sampled <= NEIGHBOURS; ++sampled) {
        SampleReservoir r = technique_reservoir(g, sampled);
        if (r.state.contribution_weight == 0.0f) continue;
        if (!MIS_VISIBILITY) {
            if (sampled > 0u) write_ray(g, 0u, r.chosen, canonical_ray_slot(MIS, false, NEIGHBOURS, sampled));
            continue;
        }
        for (uint t = 0u; t <= NEIGHBOURS; ++t) {
            if (t == sampled || !has_joined(g, t)) continue;
            if (MIS == MIS_PAIRWISE && t > 0u && sampled > 0u) continue;
            write_ray(g, t, r.chosen, technique_ray_slot(MIS, NEIGHBOURS, sampled, t));
        }
    }
}

void main() {
    ivec2 pixel = band_pixel();
    if (is_outside_band(pixel)) return;
    Receiver here;
    bool lit = load_receiver(pixel, here);
#ifdef TARN_WRITE_RAYS
    if (lit) {
        write_rays(gather(pixel, here));
    } else {
        store_no_rays(pixel);
    }
#else
    SampleReservoir result = empty_sample_reservoir();
    BrdfValue light = no_reflection();
    if (lit) {
        Gathering g = gather(pixel, here);
#ifdef TARN_CHECK_MIS
        check_weights(g);
#endif
        result = finish(g, merge_all(g, light));
    }
#ifdef TARN_SHADE_ALL
    imageStore(diffuse_image, pixel, vec4(light.diffuse, 1.0f));
    imageStore(specular_image, pixel, vec4(light.specular, 1.0f));
#endif
    store_reservoir(pixel, here, result);
#endif
}
