// Reuse over space: this pixel's sample and those of some neighbours become one.
//
// Technique 0 is the pixel itself, 1 .. neighbour_count are pixels drawn at random within a radius; those that are
// outside of the picture or show another surface are rejected and are no techniques. TARN_MIS chooses the MIS weights
// (shared/math/mis.h).
#include "lib/scene_buffers.glsl"
#include "lib/frame.glsl"
#include "lib/gbuffer.glsl"
#include "lib/counters.glsl"
#include "lib/receiver.glsl"
#include "lib/neighbour_test.glsl"
#include "lib/reuse.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

uniform uint neighbour_count;  // 1 .. 9
uniform float radius_px;
uniform uint iteration;
#ifdef TARN_SHADE_ALL
// Where all samples of this step light the pixel: the sum of m x BRDF x Le x G x visibility x W over them.
layout(binding = 0, rgba32f) uniform writeonly image2D light_image;
#endif

uniform uint mirror;  // 1: neighbours outside of the picture are mirrored into it

// The pixel and who joins it.
struct Gathering {
    ivec2 pixel;
    Receiver here;
    Reservoir canonical;
    uint joined;  // bit n: neighbour n is a technique
    float neighbour_confidence;
};

vec4 neighbour_random(ivec2 pixel, uint n) {
    return random4(pixel_key(pixel), DIMENSION_SPATIAL + 16u * iteration + n);
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
    if (any(lessThan(neighbour, ivec2(0))) || any(greaterThanEqual(neighbour, ivec2(frame_size.xy)))) return false;
    if (neighbour == pixel) return false;
    vec4 position = load_layer(neighbour, LAYER_POSITION);
    Look look = look_of_layers(position, load_layer(neighbour, LAYER_NORMALS), load_layer(neighbour, LAYER_DIFFUSE));
    Look own = look_of(here.point);
    // 1/Z gives the same weight to every technique that can draw the sample, however rarely it does: a mirror's energy
    // would depend on samples that hardly any run draws. Balance and pairwise know how likely each technique is.
#ifndef TARN_PLANT_COUNT_MIRRORS
    if (MIS == MIS_COUNT && is_mirror_like(look, own)) return false;
#endif
    return position.w >= 0.0f && is_similar(look, own, view_depth(frame_camera(), here.point.position));
}

Gathering gather(ivec2 pixel, Receiver here) {
    Gathering g;
    g.pixel = pixel;
    g.here = here;
    g.canonical = load_reservoir(in_reservoirs, pixel);
    g.joined = 0u;
    g.neighbour_confidence = 0.0f;
    for (uint n = 1u; n <= neighbour_count; ++n) {
        ivec2 neighbour = neighbour_pixel(pixel, n);
        bool joins = can_join(here, pixel, neighbour);
        g.joined |= joins ? 1u << n : 0u;
        float confidence = joins ? load_confidence(in_reservoirs, neighbour) : 0.0f;
#ifdef TARN_PLANT_COUNT_DEAD
        if (!joins) confidence = g.canonical.confidence;
#endif
        g.neighbour_confidence += confidence;
    }
    return g;
}

// The sample of technique `t`; nothing where it did not join.
Reservoir technique_reservoir(Gathering g, uint t) {
    if (t == 0u) return g.canonical;
    if (!has_joined(g, t)) return empty_reservoir();
    return load_reservoir(in_reservoirs, technique_pixel(g, t));
}

float technique_confidence(Gathering g, uint t) {
    return t == 0u ? g.canonical.confidence : load_confidence(in_reservoirs, technique_pixel(g, t));
}

// Whether `looker` sees the sample of `owner`, where the mode asks.
float answer(Gathering g, uint owner, uint looker) {
    if (!MIS_VISIBILITY || owner == looker) return 1.0f;
    return load_answer(g.pixel, technique_ray_slot(MIS, neighbour_count, owner, looker));
}

// p-hat of technique `t` at a sample, without visibility.
float technique_target(Gathering g, uint t, LightSample drawn) {
    if (t == 0u) return sample_target(g.here, drawn);
    Receiver r;
    load_receiver(technique_pixel(g, t), r);
    return sample_target(r, drawn);
}

// ---- Balance: every technique looks at every sample.

// Over all techniques, for the sample `r` of technique `owner`, whose own target is the one that it was made with.
float balance_sum(Gathering g, uint owner, Reservoir r) {
    float sum = balance_term(technique_confidence(g, owner), r.target);
    for (uint t = 0u; t <= neighbour_count; ++t) {
        if (t == owner || !has_joined(g, t)) continue;
        sum += balance_term(technique_confidence(g, t), technique_target(g, t, r.chosen) * answer(g, owner, t));
    }
    return sum;
}

// ---- Pairwise: each neighbour looks at the pixel's sample, the pixel at each neighbour's.

PairwiseStep pairwise_step(Gathering g) { return PairwiseStep(g.canonical.confidence, g.neighbour_confidence); }

float pairwise_canonical_weight(Gathering g) {
    PairwiseStep step = pairwise_step(g);
    float weight = pairwise_defensive_share(step);
    for (uint n = 1u; n <= neighbour_count; ++n) {
        if (!has_joined(g, n)) continue;
        float target = technique_target(g, n, g.canonical.chosen) * answer(g, 0u, n);
        weight += pairwise_canonical_term(step, technique_confidence(g, n), target, g.canonical.target);
    }
    return weight;
}

// ---- All modes

// m of technique `t` for its own sample; constant and count weigh by confidence and normalize at the end.
float technique_weight(Gathering g, uint t, Reservoir r, float target_here) {
    float confidence = technique_confidence(g, t);
#ifdef TARN_PLANT_SKIP_CONFIDENCE
    confidence = 1.0f;
#endif
#ifdef TARN_PLANT_DROP_NORMALIZATION
    return MIS == MIS_CONSTANT || MIS == MIS_COUNT ? confidence : 1.0f;
#endif
    if (MIS == MIS_BALANCE) return bounded_ratio(balance_term(confidence, r.target), balance_sum(g, t, r));
    if (MIS == MIS_PAIRWISE) {
        if (t == 0u) return pairwise_canonical_weight(g);
        return pairwise_neighbour_weight(pairwise_step(g), confidence, r.target, target_here);
    }
    return confidence;
}

// p-hat here at the sample of technique `t`, with visibility where the mode resamples by it.
float target_here(Gathering g, uint t, Reservoir r) {
    if (t == 0u) return r.target;
    float target = sample_target(g.here, r.chosen);
    if (MIS == MIS_BALANCE || MIS == MIS_PAIRWISE) target *= answer(g, t, 0u);
    return target;
}

// Z, or the sum of confidences.
float normalization(Gathering g, Merge m) {
    if (MIS == MIS_CONSTANT) return g.canonical.confidence + g.neighbour_confidence;
    if (MIS != MIS_COUNT) return 1.0f;
    float z = 0.0f;
    for (uint t = 0u; t <= neighbour_count; ++t) {
        if (!has_joined(g, t)) continue;
        float target = technique_target(g, t, m.live.chosen);
        if (MIS_VISIBILITY) target *= load_answer(g.pixel, t);
        z += count_term(technique_confidence(g, t), target);
    }
    return z;
}

// What a sample sends to the viewer, `share` being its m x W. Its colour is its own: averaging visibility under one
// chosen colour leaks, this does not.
vec3 shade_sample(Gathering g, Reservoir r, float share) {
    vec3 reflected = reflect_at(g.here, load_incident_light(r.chosen, g.here.point.position));
    return reflected * share * (MIS_VISIBILITY ? 1.0f : r.visibility);
}

Merge merge_all(Gathering g, out vec3 light) {
    Merge m = empty_merge();
    light = vec3(0.0f);
    for (uint t = 0u; t <= neighbour_count; ++t) {
        Reservoir r = technique_reservoir(g, t);
        if (r.contribution_weight == 0.0f) continue;
        float target = target_here(g, t, r);
#ifndef TARN_WRITE_RAYS
        if (VISIBILITY_IS_KNOWN && t > 0u && !MIS_VISIBILITY) {
            r.visibility = load_answer(g.pixel, canonical_ray_slot(MIS, false, neighbour_count, t));
        }
#endif
        float weight = technique_weight(g, t, r, target) * target * r.contribution_weight;
#ifdef TARN_PLANT_TARGET_AT_NEIGHBOUR
        if (target > 0.0f) weight *= r.target / target;
#endif
        offer_merged(m, r, target, weight, neighbour_random(g.pixel, t).z);
#ifdef TARN_SHADE_ALL
        if (weight > 0.0f && is_finite(weight)) light += shade_sample(g, r, weight / target);
#endif
    }
    return m;
}

Reservoir finish(Gathering g, Merge m) {
    Reservoir result = finish_merge(m, g.canonical.confidence + g.neighbour_confidence, normalization(g, m));
    // Count resamples without visibility: a sample that this pixel does not see ends here.
    if (MIS == MIS_COUNT && MIS_VISIBILITY && load_answer(g.pixel, 0u) == 0.0f) result.contribution_weight = 0.0f;
    return result;
}

#ifdef TARN_CHECK_MIS
// The weights of all techniques at each sample sum to 1; a debugging aid, quadratic in the techniques.
void check_weights(Gathering g) {
    if (MIS != MIS_BALANCE && MIS != MIS_PAIRWISE) return;
    for (uint owner = 0u; owner <= neighbour_count; ++owner) {
        Reservoir r = technique_reservoir(g, owner);
        float here = target_here(g, owner, r);
        if (r.contribution_weight == 0.0f || here == 0.0f) continue;
        float sum = MIS == MIS_PAIRWISE ? pairwise_defensive_share(pairwise_step(g)) : 0.0f;
        for (uint t = 0u; t <= neighbour_count; ++t) {
            if (!has_joined(g, t)) continue;
            float target = t == owner ? r.target : technique_target(g, t, r.chosen);
            if (MIS == MIS_BALANCE) {
                target *= answer(g, owner, t);
                sum += bounded_ratio(balance_term(technique_confidence(g, t), target), balance_sum(g, owner, r));
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

void write_ray(Gathering g, uint looker, LightSample drawn, uint slot) {
    ivec2 pixel = technique_pixel(g, looker);
    Receiver r;
    load_receiver(pixel, r);
    store_ray(g.pixel, slot, sample_ray(r, drawn, pixel));
}

void write_rays(Gathering g) {
    store_no_rays(g.pixel);
    if (MIS == MIS_COUNT && MIS_VISIBILITY) {
        vec3 light;
        LightSample chosen = merge_all(g, light).live.chosen;
        for (uint t = 0u; t <= neighbour_count; ++t) {
            if (has_joined(g, t)) write_ray(g, t, chosen, t);
        }
        return;
    }
    for (uint owner = 0u; owner <= neighbour_count; ++owner) {
        Reservoir r = technique_reservoir(g, owner);
        if (r.contribution_weight == 0.0f) continue;
        if (!MIS_VISIBILITY) {
            if (owner > 0u) write_ray(g, 0u, r.chosen, canonical_ray_slot(MIS, false, neighbour_count, owner));
            continue;
        }
        for (uint looker = 0u; looker <= neighbour_count; ++looker) {
            if (looker == owner || !has_joined(g, looker)) continue;
            if (MIS == MIS_PAIRWISE && looker > 0u && owner > 0u) continue;
            write_ray(g, looker, r.chosen, technique_ray_slot(MIS, neighbour_count, owner, looker));
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
    Reservoir result = empty_reservoir();
    vec3 light = vec3(0.0f);
    if (lit) {
        Gathering g = gather(pixel, here);
#ifdef TARN_CHECK_MIS
        check_weights(g);
#endif
        result = finish(g, merge_all(g, light));
    }
#ifdef TARN_SHADE_ALL
    imageStore(light_image, pixel, vec4(light, 1.0f));
#endif
    store_reservoir(pixel, here, result);
#endif
}
