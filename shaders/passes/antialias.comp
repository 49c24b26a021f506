// Antialiasing over time: joins the samples of this frame, each of which lies in another place of its pixel than in the
// frames before (find_jitter), with the picture of the last frames, which has the size of what is shown.
//
// The past is a mean and a count of the samples behind it (w), so that each sample weighs the same and a picture at rest
// becomes the integral over each pixel: of linear radiance, so that no energy is lost, or of what the display shows, so
// that edges of lamps are smooth too. The count ends at `greatest_count`.
//
// Where things move, the past is read where the nearest surface around the pixel was (edges move with what is in front),
// by a cubic over the 12 pixels without the corners, kept near the range of the four inner ones: sharp, and little
// ringing. Where it may be wrong (lib/antialias/trust.glsl), what the colours of this frame around the pixel do not
// explain is moved towards their mean until it lies within CLIP deviations (Salvi 2016, in the compressed colours of
// Karis 2014). Elsewhere, and at rest, it is taken as it is: single frames miss what is smaller than a pixel.
//
// Where less is rendered than is shown, each pixel weighs the samples by their distance from its centre. What no frame
// has shown before is interpolated.
//
// Samples that are no light, or far above all around them and not light of their own surface, are left out and counted.
//
// What lamps emit beyond white has no noise, and little of it makes a pixel white: read again in every frame, it would
// spread over all around a lamp. So that excess is kept out of the mean. In motion the picture shows this frame's alone, at
// rest a mean of its own, whose count is the same for all pixels (`excess_share`).
//
// TARN_AT_REST: nothing has moved or changed since the last frame. TARN_ENLARGE: less is rendered than is shown.
// TARN_DISPLAY_MEAN: the mean is that of compressed colours, of which white is the display's: nothing exceeds it, and the
// mean is the picture.
#include "shared/interface/constants/antialias.h"
#include "lib/frame.glsl"
#include "lib/gbuffer.glsl"
#include "lib/counters.glsl"
#include "lib/previous_camera.glsl"
#include "shared/math/antialias.h"
#include "shared/math/denoise.h"
#include "lib/antialias/trust.glsl"
#include "lib/pixel_group.glsl"

layout(binding = UNIT_PASS_A) uniform sampler2D frame_radiance;
layout(binding = UNIT_PASS_B) uniform sampler2D last_mean;
layout(binding = UNIT_PASS_C) uniform usamplerBuffer exposure;
layout(binding = 0, rgba32f) writeonly uniform image2D out_mean;
#ifndef TARN_DISPLAY_MEAN
layout(binding = UNIT_PASS_E) uniform sampler2D last_picture;
layout(binding = 1, rgba32f) writeonly uniform image2D out_picture;
#endif

const int CENTRE = 4;

// Where in a pixel this frame's sample is, from its centre.
vec2 sample_jitter() {
#ifdef TARN_PLANT_FLIPPED_JITTER
    return vec2(frame_jitter.x, -frame_jitter.y);
#else
    return frame_jitter.xy;
#endif
}

// ---- What the picture is a mean of

// Radiance near white on the display.
float white() { return 1.0f / max(uintBitsToFloat(texelFetch(exposure, 0).x), 1e-30f); }

#ifdef TARN_DISPLAY_MEAN
vec3 to_mean(vec3 radiance) { return compress_colour(radiance, white()); }
vec3 from_mean(vec3 mean) { return expand_colour(mean, white()); }
#else
vec3 to_mean(vec3 radiance) { return radiance; }
vec3 from_mean(vec3 mean) { return mean; }
#endif

// ---- Samples

bool is_usable(vec4 value) {
#ifdef TARN_PLANT_UNSANITIZED
    return true;
#else
    return value.w > 0.0f && is_usable_light(value.xyz);
#endif
}

// ---- What lamps emit beyond white

// How much of a sample's light that is; `value.w`: see passes/composite.comp.
float excess_share(vec4 value) {
#if !defined(TARN_DISPLAY_MEAN) && !defined(TARN_PLANT_LAMPS_WITH_A_PAST)
    float emitted = value.w - 1.0f;
    return max(0.0f, emitted - white() * ratio_or_zero(1.0f, luminance(value.xyz)));
#else
    return 0.0f;
#endif
}

// ---- The past

// Of a pixel: mean, and samples behind it.
struct Past {
    vec3 radiance;
    float count;
    bool trusted;  // it needs no clipping
};

// Pixels of the picture for a pixel of the frame.
vec2 enlargement() { return vec2(imageSize(out_mean)) / vec2(frame_size.xy); }

vec4 load_last(ivec2 pixel) {
    return texelFetch(last_mean, clamp(pixel, ivec2(0), textureSize(last_mean, 0) - 1), 0);
}

// The last mean at `place`, in pixels from its corner: by the cubic, or linearly where contrast is high, so that it
// neither rings nor makes energy beside small lamps. The count is that of the pixel there.
vec4 sample_last(vec2 place) {
    const float MOST_CONTRAST = 5.0f;
    vec2 from_centre = place - 0.5f;
    ivec2 first = ivec2(floor(from_centre));
    vec2 share = from_centre - floor(from_centre);
    vec4 x = cubic_weights(share.x);
    vec4 y = cubic_weights(share.y);
    // Without the corners the weights do not sum to 1.
    float scale = 1.0f / (1.0f - (x.x + x.w) * (y.x + y.w));
    vec4 inner[4];
    vec3 cubic = vec3(0.0f);
    float least = 3e38f, greatest = 0.0f;
    for (int tap = 0; tap < 16; ++tap) {
        ivec2 offset = ivec2(tap % 4, tap / 4);
        bvec2 outer = bvec2(offset.x == 0 || offset.x == 3, offset.y == 0 || offset.y == 3);
        if (all(outer)) continue;
        vec4 texel = load_last(first + offset - 1);
        float light = luminance(texel.xyz);
        cubic += x[offset.x] * y[offset.y] * texel.xyz;
        least = min(least, light);
        greatest = max(greatest, light);
        if (!any(outer)) inner[2 * (offset.y - 1) + offset.x - 1] = texel;
    }
    vec3 linear =
        mix(mix(inner[0].xyz, inner[1].xyz, share.x), mix(inner[2].xyz, inner[3].xyz, share.x), share.y);
    bool smooth_enough = greatest <= MOST_CONTRAST * least;
    int nearest = (share.x < 0.5f ? 0 : 1) + (share.y < 0.5f ? 0 : 2);
    return vec4(smooth_enough ? max(cubic * scale, vec3(0.0f)) : linear, inner[nearest].w);
}

#ifndef TARN_AT_REST
// Whether the past may be wrong. Where something was laid bare or hidden it counts little, and is clipped; in a larger
// picture until new samples outweigh it, since pixels there wait for theirs. `place`: where the past was, in pixels of the
// last frame.
Past judge(Past past, Nearest present, vec2 motion, vec2 place) {
    const float DOUBTED_COUNT = 2.0f;  // samples of the frame
    const float SETTLED_COUNT = 4.0f;  // of the picture
#ifdef TARN_PLANT_NO_TRUST
    return past;
#endif
    if (trusts_past == 0u) return past;
    float scale = 1.0f / (enlargement().x * enlargement().y);
    Nearest before = find_nearest_previous(ivec2(place));
    bool along = has_come_along(motion, before, enlargement());
    past.trusted = along && is_lit_as_before(present, before);
#ifdef TARN_ENLARGE
    past.trusted = past.trusted && past.count >= SETTLED_COUNT;
#endif
    past.count = along ? past.count : min(past.count, DOUBTED_COUNT * scale);
    return past;
}
#endif

// `nearest`: the frame's pixel whose sample is nearest to `pixel` of the picture.
Past find_past(ivec2 pixel, ivec2 nearest) {
    bool usable = has_previous != 0u;
#ifndef TARN_PLANT_FOREIGN_SIZE
    usable = usable && textureSize(last_mean, 0) == imageSize(out_mean);
#endif
    if (!usable) return Past(vec3(0.0f), 0.0f, true);
#ifdef TARN_AT_REST
    return Past(load_last(pixel).xyz, load_last(pixel).w, true);
#else
    Nearest present = find_nearest(nearest);
    vec2 motion = find_motion(present);
    vec2 place = vec2(pixel) + 0.5f - motion * enlargement();
    vec2 size = vec2(textureSize(last_mean, 0));
    // What lies far outside has no integer.
    if (!(place.x >= 0.0f && place.y >= 0.0f && place.x < size.x && place.y < size.y))
        return Past(vec3(0.0f), 0.0f, true);
    vec4 last = sample_last(place);
    return judge(Past(last.xyz, min(last.w, steady_count), false), present, motion, place / enlargement());
#endif
}

// ---- The present

// Samples of this frame around a pixel, without their excess; black where they may not be used.
struct Around {
    vec3 radiance[TAPS];
    vec3 excess[TAPS];
    float usable[TAPS];  // 1 or 0
};

// A sum, and the weight of the samples in it.
struct Weighed {
    vec3 sum;
    float weight;
};

// What they come to for the pixel.
struct Present {
    Weighed rest;
    Weighed excess;
    bool complete;  // whether the nearest sample is a part of it
};

// Whether light stands out from all around it without being light of the surface itself, such as a small lamp's.
bool is_stray(vec4 value, float greatest_around) {
#ifdef TARN_PLANT_UNSANITIZED
    return false;
#else
    vec3 reflected = (2.0f - value.w) * value.xyz;
    return exceeds_all_around(value.xyz, greatest_around) && exceeds_all_around(reflected, greatest_around);
#endif
}

Around load_around(ivec2 pixel) {
    Around around;
    float greatest = 0.0f, second = 0.0f;
    int brightest = CENTRE;
    for (int tap = 0; tap < TAPS; ++tap) {
        ivec2 place = pixel + tap_offset(tap);
        ivec2 inside = clamp_to_frame(place);
        vec4 value = texelFetch(frame_radiance, inside, 0);
        bool usable = inside == place && is_usable(value);
        around.usable[tap] = usable ? 1.0f : 0.0f;
        float share = excess_share(value);
        around.radiance[tap] = usable ? (1.0f - share) * value.xyz : vec3(0.0f);
        around.excess[tap] = usable ? share * value.xyz : vec3(0.0f);
        float light = usable ? luminance(value.xyz) : 0.0f;
        second = max(second, min(light, greatest));
        brightest = light > greatest ? tap : brightest;
        greatest = max(greatest, light);
    }
    ivec2 place = clamp_to_frame(pixel + tap_offset(brightest));
    if (is_stray(texelFetch(frame_radiance, place, 0), second)) {
        for (int tap = 0; tap < TAPS; ++tap) {
            around.usable[tap] = tap == brightest ? 0.0f : around.usable[tap];
            around.radiance[tap] = tap == brightest ? vec3(0.0f) : around.radiance[tap];
            around.excess[tap] = tap == brightest ? vec3(0.0f) : around.excess[tap];
        }
    }
    return around;
}

// The past, as far as the colours around explain it.
vec3 clip_past(Past past, Around around) {
    const float CLIP = 2.5f;  // deviations: less would take more energy from what single frames miss
    const float LEAST_SIZE = 1e-5f;
    float key = luminance(around.radiance[CENTRE]) + luminance(past.radiance) + 1e-20f;
    vec3 sum = vec3(0.0f), squares = vec3(0.0f);
    float count = 0.0f;
    for (int tap = 0; tap < TAPS; ++tap) {
        vec3 colour = compress_colour(around.radiance[tap], key);
        sum += around.usable[tap] * colour;
        squares += around.usable[tap] * colour * colour;
        count += around.usable[tap];
    }
    if (count == 0.0f) return past.radiance;
    vec3 mean = sum / count;
    vec3 deviation = sqrt(max(squares / count - mean * mean, vec3(0.0f)));
    vec3 colour = compress_colour(past.radiance, key);
    float excess = box_excess(colour, mean, CLIP * deviation + LEAST_SIZE);
    return excess > 1.0f ? expand_colour(mean + (colour - mean) / excess, key) : past.radiance;
}

// Weight of all samples around a pixel behind which there are few, so that none is left without.
float find_wide(bool complete, float known) {
#ifdef TARN_ENLARGE
    const float WIDE = 0.02f;
    return WIDE * max(0.0f, 1.0f - known);
#else
    return complete || known > 0.0f ? 0.0f : 1e-3f;
#endif
}

// `offset`: from the centre of the picture's pixel to the sample of the middle tap, in pixels of the frame. Samples
// behind the past, and behind its excess: `known` and `known_excess`.
Present weigh(Around around, vec2 offset, float known, float known_excess) {
    Weighed none = Weighed(vec3(0.0f), 0.0f);
    Present present = Present(none, none, around.usable[CENTRE] > 0.0f);
    float wide = find_wide(present.complete, known);
    float wide_excess = find_wide(present.complete, known_excess);
    for (int tap = 0; tap < TAPS; ++tap) {
        vec2 from_centre = offset + vec2(tap_offset(tap));
#ifdef TARN_ENLARGE
        float narrow = sample_weight(from_centre * enlargement());
        float tent = tent_weight(from_centre);
#else
        float narrow = tap == CENTRE ? 1.0f : 0.0f;
        float tent = 1.0f;
#endif
        float weight = (narrow + wide * tent) * around.usable[tap];
        present.rest.sum += weight * to_mean(around.radiance[tap]);
        present.rest.weight += weight;
#ifndef TARN_DISPLAY_MEAN
        weight = (narrow + wide_excess * tent) * around.usable[tap];
        present.excess.sum += weight * around.excess[tap];
        present.excess.weight += weight;
#endif
    }
    return present;
}

// The one sample of a pixel at rest, where the picture has the frame's size. Looks around it only where it stands out
// from the past.
Present load_sample(ivec2 pixel, Past past, float known_excess) {
    vec4 value = texelFetch(frame_radiance, pixel, 0);
    float share = excess_share(value);
    vec3 rest = (1.0f - share) * value.xyz;
    bool odd =
        !is_usable(value) || past.count == 0.0f || luminance(rest) > STRAY_RATIO * luminance(past.radiance);
    if (odd) return weigh(load_around(pixel), vec2(0.0f), past.count, known_excess);
    return Present(Weighed(to_mean(rest), 1.0f), Weighed(share * value.xyz, 1.0f), true);
}

// ---- Both

// A mean, to the bit where all values are equal.
vec3 join(vec3 mean, float count, Weighed present) {
    vec3 step = present.sum - present.weight * mean;
    return mean + step * ratio_or_zero(1.0f, count + present.weight);
}

// Of the pixel, and the samples behind it: the past of what lamps emit beyond white.
vec4 load_last_excess(ivec2 pixel, Past past) {
#if !defined(TARN_DISPLAY_MEAN) && defined(TARN_AT_REST) && !defined(TARN_PLANT_LATEST_EXCESS)
    if (past.count > 0.0f) {
        vec4 texel = texelFetch(last_picture, pixel, 0);
        return vec4(max(texel.xyz - past.radiance, vec3(0.0f)), texel.w);
    }
#endif
    return vec4(0.0f);
}

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, imageSize(out_mean)))) return;
    vec2 place = (vec2(pixel) + 0.5f) / enlargement() - sample_jitter();
    ivec2 nearest = clamp_to_frame(ivec2(floor(place)));
    Past past = find_past(pixel, nearest);
    vec4 last_excess = load_last_excess(pixel, past);
#if defined(TARN_AT_REST) && !defined(TARN_ENLARGE)
    Present present = load_sample(pixel, past, last_excess.w);
#else
    Around around = load_around(nearest);
#if !defined(TARN_AT_REST) && !defined(TARN_PLANT_NO_CLIP)
    if (!past.trusted) past.radiance = clip_past(past, around);
#endif
    Present present = weigh(around, vec2(nearest) + 0.5f - place, past.count, last_excess.w);
#endif
    if (!present.complete) count_event(COUNTER_BAD_PICTURE);
    vec3 mean = from_mean(join(to_mean(past.radiance), past.count, present.rest));
    float count = add_to_count(past.count, present.rest.weight, steady_count, greatest_count);
    imageStore(out_mean, pixel, vec4(mean, count));
#ifndef TARN_DISPLAY_MEAN
    vec3 excess = join(last_excess.xyz, last_excess.w, present.excess);
    float excess_count = min(last_excess.w + present.excess.weight, greatest_count);
    imageStore(out_picture, pixel, vec4(mean + excess, excess_count));
#endif
}
