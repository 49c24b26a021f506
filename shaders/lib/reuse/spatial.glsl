// Reuse over space: this pixel's sample and those of some neighbours become one.
//
// Technique 0 is the pixel itself, 1 .. NEIGHBOURS are pixels drawn at random within a radius; those that are outside of
// the picture or show another surface are left out and are no techniques. How the samples are weighed, TARN_MIS says
// (shared/math/mis.h). Densities are those of the pixel's domain: a technique's own target times the Jacobian of the
// shift from the pixel to it.
#include "lib/reuse/merge.glsl"

const uint NEIGHBOURS = TARN_NEIGHBOURS;  // 1 .. 9

// A loop over the neighbours; a single one is no loop, which compilers leave standing around large bodies.
#if TARN_NEIGHBOURS == 1
#define FOR_NEIGHBOURS(n) const uint n = 1u;
#else
#define FOR_NEIGHBOURS(n) for (uint n = 1u; n <= NEIGHBOURS; ++n)
#endif

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

// Inside of the picture, also where the neighbour is not and has not joined: what is read there is thrown away. Drivers
// on the CPU run both sides of every branch, so that most of what follows selects results and has no branches.
ivec2 technique_pixel(Gathering g, uint t) {
    return t == 0u ? g.pixel : clamp(neighbour_pixel(g.pixel, t), ivec2(0), ivec2(frame_size.xy) - 1);
}

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
    FOR_NEIGHBOURS(n) {
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

// The sample of technique `t`; one without weight where it did not join.
SampleReservoir technique_reservoir(Gathering g, uint t) {
    if (t == 0u) return g.canonical;
    SampleReservoir r = load_reservoir(in_reservoirs, technique_pixel(g, t));
    r.state.contribution_weight = has_joined(g, t) ? r.state.contribution_weight : 0.0f;
    return r;
}

float technique_confidence(Gathering g, uint t) {
    return t == 0u ? g.canonical.state.confidence : load_confidence(in_reservoirs, technique_pixel(g, t));
}

// In the numerator of a weight.
float own_confidence(Gathering g, uint t) {
#ifdef TARN_PLANT_SKIP_CONFIDENCE
    return 1.0f;
#endif
    return technique_confidence(g, t);
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

PairwiseStep pairwise_step(Gathering g) {
    return PairwiseStep(g.canonical.state.confidence, g.neighbour_confidence);
}

// ---- Weights: m of a technique for its own sample; those of 1/M and 1/Z are divided at the end. The pixel's own and
// its neighbours' are apart, for drivers on the CPU run both sides of every branch.

// Over all techniques, for the pixel's sample.
float canonical_balance_sum(Gathering g) {
    float sum = balance_term(g.canonical.state.confidence, g.canonical.state.target);
    FOR_NEIGHBOURS(n) {
        float target = technique_target(g, n, g.canonical.chosen) * answer(g, 0u, n);
        float term = balance_term(technique_confidence(g, n), target);
        sum += has_joined(g, n) ? term : 0.0f;
    }
    return sum;
}

float pairwise_canonical_weight(Gathering g) {
    PairwiseStep step = pairwise_step(g);
    float weight = pairwise_defensive_share(step);
    FOR_NEIGHBOURS(n) {
        float target = technique_target(g, n, g.canonical.chosen) * answer(g, 0u, n);
        float term =
            pairwise_canonical_term(step, technique_confidence(g, n), target, g.canonical.state.target);
        weight += has_joined(g, n) ? term : 0.0f;
    }
    return weight;
}

float canonical_weight(Gathering g) {
    float confidence = own_confidence(g, 0u);
    if (MIS == MIS_BALANCE)
        return bounded_ratio(balance_term(confidence, g.canonical.state.target), canonical_balance_sum(g));
    if (MIS == MIS_PAIRWISE) return pairwise_canonical_weight(g);
    return confidence;
}

// Over all techniques, for the sample `r` of neighbour `n`, whose target is `own` there and `here` at the pixel.
float balance_sum(Gathering g, uint n, SampleReservoir r, float own, float here) {
    float sum = balance_term(technique_confidence(g, n), own);
    sum += balance_term(g.canonical.state.confidence, here);
    if (NEIGHBOURS == 1u) return sum;
    for (uint t = 1u; t <= NEIGHBOURS; ++t) {
        if (t == n || !has_joined(g, t)) continue;
        float target = technique_target(g, t, r.chosen) * answer(g, n, t);
        sum += balance_term(technique_confidence(g, t), target);
    }
    return sum;
}

float neighbour_weight(Gathering g, uint n, SampleReservoir r, float target_here) {
    float confidence = own_confidence(g, n);
    float own = own_target(g, n, r);
    if (MIS == MIS_BALANCE)
        return bounded_ratio(balance_term(confidence, own), balance_sum(g, n, r, own, target_here));
    if (MIS == MIS_PAIRWISE) return pairwise_neighbour_weight(pairwise_step(g), confidence, own, target_here);
    return confidence;
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

// Offers the sample of technique `t` and adds its light: it sends `reflected` to the viewer. Its colour is its own;
// averaging visibility under one chosen colour leaks, this does not.
void offer(Gathering g, uint t, SampleReservoir r, float target, float weight, BrdfValue reflected,
           inout Merge m, inout BrdfValue light) {
#ifdef TARN_PLANT_DROP_NORMALIZATION
    if (WEIGHTS_SUM_TO_ONE) weight = target * own_contribution_weight(g, t, r);
#endif
#ifdef TARN_PLANT_TARGET_AT_NEIGHBOUR
    if (target > 0.0f) weight *= r.state.target / target;
#endif
    offer_merged(m, r, target, weight, neighbour_random(g.pixel, t).z);
#ifdef TARN_SHADE_ALL
    if (weight > 0.0f && is_finite(weight)) {
        float factor = weight / target * (MIS_VISIBILITY ? 1.0f : r.state.visibility);
        light.diffuse += reflected.diffuse * factor;
        light.specular += reflected.specular * factor;
    }
#endif
}

// Visibility of neighbour `n`'s sample from here, where a ray of this step has found it.
float find_visibility(Gathering g, uint n, SampleReservoir r) {
#ifndef TARN_WRITE_RAYS
    if (VISIBILITY_IS_KNOWN && !MIS_VISIBILITY)
        return load_answer(g.pixel, canonical_ray_slot(MIS, false, NEIGHBOURS, n));
#endif
    return r.state.visibility;
}

Merge merge_all(Gathering g, out BrdfValue light) {
    Merge m = empty_merge();
    light = no_reflection();
    SampleReservoir own = g.canonical;
    float own_weight = canonical_weight(g) * own.state.target * own.state.contribution_weight;
    offer(g, 0u, own, own.state.target, own_weight, reflect_sample(g.here, own.chosen), m, light);
    FOR_NEIGHBOURS(n) {
        SampleReservoir r = technique_reservoir(g, n);
        BrdfValue reflected = reflect_sample(g.here, r.chosen);
        // With visibility where the mode resamples by it.
        float target = target_of(g.here, reflected) * (WEIGHTS_SUM_TO_ONE ? answer(g, n, 0u) : 1.0f);
        r.state.visibility = find_visibility(g, n, r);
        float contribution = own_contribution_weight(g, n, r);
        float weight = neighbour_weight(g, n, r, target) * target * contribution;
        offer(g, n, r, target, contribution == 0.0f ? 0.0f : weight, reflected, m, light);
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
        float here =
            sampled == 0u ? r.state.target : sample_target(g.here, r.chosen) * answer(g, sampled, 0u);
        if (!holds_sample(r) || here == 0.0f) continue;
        float sum = MIS == MIS_PAIRWISE ? pairwise_defensive_share(pairwise_step(g)) : 0.0f;
        for (uint t = 0u; t <= NEIGHBOURS; ++t) {
            if (!has_joined(g, t)) continue;
            float target = t == sampled ? own_target(g, t, r) : technique_target(g, t, r.chosen);
            if (MIS == MIS_BALANCE) {
                target *= answer(g, sampled, t);
                float all = sampled == 0u ? canonical_balance_sum(g)
                                          : balance_sum(g, sampled, r, own_target(g, sampled, r), here);
                sum += bounded_ratio(balance_term(technique_confidence(g, t), target), all);
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
    // Without visibility in the weights only the neighbours' samples are asked for.
    for (uint sampled = MIS_VISIBILITY ? 0u : 1u; sampled <= NEIGHBOURS; ++sampled) {
        SampleReservoir r = technique_reservoir(g, sampled);
        if (r.state.contribution_weight == 0.0f) continue;
        if (!MIS_VISIBILITY) {
            write_ray(g, 0u, r.chosen, canonical_ray_slot(MIS, false, NEIGHBOURS, sampled));
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
