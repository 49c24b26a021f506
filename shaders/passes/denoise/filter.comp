// A step of the denoiser's filter: a mean over pixels around that show the same surface in the same light. The taps of
// each step stand twice as far apart as those of the one before ("a trous", with holes: Dammertz et al. 2010), so that a
// few steps of few taps reach far.
//
// The weight of a tap is a product: the kernel, how far it lies from the pixel's plane, how far its normal is turned, and
// how far its luminance differs, measured by what the variance of both explains. Base and layer have weights of their
// own: that of the layer also falls with the angle under which the taps lie apart, over the width of its lobe, so that
// mirrors keep what they show. All are divided by their sum. The variance goes along: that of a mean is the sum of squared weights times variances.
//
// The filter of Schied et al. blurs the variance before it asks it. Here a tap's own variance counts beside that of the
// pixel: weights are alike both ways, so that light that a pixel takes others give, and the energy stays.
//
// The first step also finds the variance among its taps where the history is short, and makes the history of the next
// frame: what it has found, but where the history is short what it was given. There the variance is a guess, and what
// a guess blurs the history would keep for long.
//
// TARN_FIRST_STEP, TARN_LAST_STEP; the last one gives the layer its albedo back.
// TARN_KERNEL_CROSS, TARN_KERNEL_BOX3, TARN_KERNEL_BOX5: 5, 9, 25 taps.
// TARN_BILATERAL: by surfaces alone.
#include "shared/interface/constants/denoise.h"
#include "lib/frame.glsl"
#include "lib/gbuffer.glsl"
#include "lib/counters.glsl"
#include "lib/denoise/pictures.glsl"
#include "lib/denoise/layer_share.glsl"
#include "lib/pixel_group.glsl"

layout(binding = UNIT_PASS_A) uniform sampler2D in_guide;
layout(binding = UNIT_PASS_B) uniform sampler2D in_diffuse;
layout(binding = UNIT_PASS_C) uniform sampler2D in_specular;
layout(binding = 0, rgba32f) writeonly uniform image2D out_diffuse;
layout(binding = 1, rgba32f) writeonly uniform image2D out_specular;
#ifdef TARN_FIRST_STEP
layout(binding = 2, rgba32f) writeonly uniform image2D kept_diffuse;
layout(binding = 3, rgba32f) writeonly uniform image2D kept_specular;
#endif

#if defined(TARN_KERNEL_BOX5)
const int REACH = 2;
#else
const int REACH = 1;
#endif

// Of a row or column of the kernel: binomial, of three or five.
float kernel_factor(int offset) {
    float distance = abs(float(offset));
#if defined(TARN_KERNEL_BOX5)
    return 0.375f - distance * (0.09375f + 0.03125f * distance);
#else
    return 0.5f - 0.25f * distance;
#endif
}

// What a pixel compares its taps with.
struct Centre {
    ivec2 pixel;
    PlaneView plane;
    float plane_scale;  // 1 / tolerance
    vec2 normal;
    vec2 normal_scale;  // base, layer: 1 / greatest squared distance
    float alpha;
    float lobe_scale;  // squared: widths of the layer's lobe by which the view turns from a pixel to the next
    vec2 luminances;
    vec2 variances;
};

// The mean of base or layer as it grows.
struct Mean {
    vec3 light;
    float weight;
    float variance;
#ifdef TARN_FIRST_STEP
    float difference;  // of luminance from the pixel's own, and its square
    float square;
#endif
};

Mean no_mean() {
#ifdef TARN_FIRST_STEP
    return Mean(vec3(0.0f), 0.0f, 0.0f, 0.0f, 0.0f);
#else
    return Mean(vec3(0.0f), 0.0f, 0.0f);
#endif
}

Centre load_centre(ivec2 pixel, Guide guide, vec4 diffuse, vec4 specular) {
    const float TOLERANCE_PX = 3.0f;
    const float MAX_SQUARED_CHORD = 0.2f;   // of the base: 26 degrees
    const float LEAST_LAYER_CHORD = 0.01f;  // of a mirror
    const float LOBE_WIDTHS = 1.0f;         // beyond which a tap sees another reflection
    CameraRecord camera = frame_camera();
    vec3 position = load_layer(pixel, LAYER_POSITION).xyz;
    vec3 normal = decode_octahedral(load_layer(pixel, LAYER_NORMALS).xy);
    Centre c;
    c.pixel = pixel;
    c.plane = make_plane_view(camera, frame_jitter.xy, vec2(frame_size.xy), position, normal);
    c.plane_scale = 1.0f / (TOLERANCE_PX * pixel_height(camera, float(frame_size.y), guide.depth));
    c.normal = guide.normal;
    float layer_chord = mix(LEAST_LAYER_CHORD, MAX_SQUARED_CHORD, min(1.0f, 2.0f * guide.alpha));
    c.normal_scale = chord_factor(guide.normal) / vec2(MAX_SQUARED_CHORD, layer_chord);
    c.alpha = guide.alpha;
    float turn = camera.orthographic ? 0.0f : pixel_height(camera, float(frame_size.y), 1.0f);
    c.lobe_scale = turn * turn / (LOBE_WIDTHS * LOBE_WIDTHS * guide.alpha * guide.alpha);
    c.luminances = vec2(luminance(diffuse.xyz), luminance(specular.xyz));
    c.variances = vec2(max(diffuse.w, 0.0f), max(specular.w, 0.0f));
    return c;
}

// Light of which nothing is known takes what it is given: its luminance says nothing.
float luminance_weight(float own, float own_variance, bool known, float found, float found_variance) {
#if defined(TARN_BILATERAL)
    return 1.0f;
#else
#ifdef TARN_PLANT_DROP_VARIANCE
    own_variance = 0.0f;
    found_variance = 0.0f;
#endif
    float differs = luminance_difference(own, found, own_variance + found_variance, luminance_factor);
    return known ? fade(differs) : 1.0f;
#endif
}

void add(inout Mean mean, vec4 light, float weight, float difference) {
    mean.light += weight * light.xyz;
    mean.weight += weight;
    mean.variance += weight * weight * light.w;
#ifdef TARN_FIRST_STEP
    mean.difference += weight * difference;
    mean.square += weight * difference * difference;
#endif
}

void add_tap(inout Mean base, inout Mean layer, Centre c, bvec2 known, ivec2 offset, float kernel) {
    ivec2 pixel = c.pixel + offset * step_px;
    ivec2 place = clamp(pixel, ivec2(0), ivec2(frame_size.xy) - 1);
    float inside = pixel == place ? kernel : 0.0f;
    Guide guide = unpack_guide(texelFetch(in_guide, place, 0));
    float away = plane_distance(c.plane, vec2(pixel), guide.depth) * c.plane_scale;
    vec2 turned = guide.normal - c.normal;
    float chord = dot(turned, turned);
    float near = inside * fade(away * away);
    vec4 light = texelFetch(in_diffuse, place, 0);
    float value = luminance(light.xyz);
    float weight = is_known(light) ? near * fade(chord * c.normal_scale.x) : 0.0f;
    weight *= luminance_weight(c.luminances.x, c.variances.x, known.x, value, light.w);
    add(base, light, weight, value - c.luminances.x);
#ifndef TARN_LAMBERT_ONLY
    const float MAX_ALPHA_DIFFERENCE = 0.25f;
    float rougher = (guide.alpha - c.alpha) * (1.0f / MAX_ALPHA_DIFFERENCE);
#ifndef TARN_PLANT_WIDE_LOBES
    vec2 away_px = vec2(pixel - c.pixel);
    near *= fade(dot(away_px, away_px) * c.lobe_scale);
#endif
    light = texelFetch(in_specular, place, 0);
    value = luminance(light.xyz);
    weight = is_known(light) ? near * fade(chord * c.normal_scale.y) * fade(rougher * rougher) : 0.0f;
    weight *= luminance_weight(c.luminances.y, c.variances.y, known.y, value, light.w);
    add(layer, light, weight, value - c.luminances.y);
#endif
}

void add_taps(inout Mean base, inout Mean layer, Centre c, bvec2 known) {
#if defined(TARN_KERNEL_CROSS)
    // Arms along the rows, then along the diagonals, by turns.
    ivec2 first = is_diagonal != 0u ? ivec2(1, 1) : ivec2(1, 0);
    ivec2 second = ivec2(-first.y, first.x);
    const float ARM = 0.5f;  // of the centre's weight
    add_tap(base, layer, c, known, first, ARM);
    add_tap(base, layer, c, known, second, ARM);
    add_tap(base, layer, c, known, -first, ARM);
    add_tap(base, layer, c, known, -second, ARM);
#else
    for (int y = -REACH; y <= REACH; ++y) {
        for (int x = -REACH; x <= REACH; ++x) {
            float kernel = kernel_factor(x) * kernel_factor(y);
            if (x != 0 || y != 0) add_tap(base, layer, c, known, ivec2(x, y), kernel);
        }
    }
#endif
}

float centre_weight() {
#if defined(TARN_KERNEL_CROSS)
    return 1.0f;
#else
    return kernel_factor(0) * kernel_factor(0);
#endif
}

// The mean, and the variance of its luminance.
vec4 finish(Mean mean, float frames) {
    if (mean.weight == 0.0f) return UNKNOWN_LIGHT;
    float scale = 1.0f / mean.weight;
#ifdef TARN_PLANT_DROP_FILTER_NORMALIZATION
    return vec4(mean.light, mean.variance);
#endif
    float variance = mean.variance * scale * scale;
#ifdef TARN_FIRST_STEP
    float difference = mean.difference * scale;
    float among_taps = max(0.0f, mean.square * scale - difference * difference);
    variance = frames < FEW_FRAMES ? among_taps : variance;
#endif
    return vec4(mean.light * scale, variance);
}

vec4 sanitize(vec4 light) {
#ifndef TARN_PLANT_UNSANITIZED
    if (!is_finite(dot(light, vec4(1.0f)))) {
        count_event(COUNTER_BAD_LIGHT_HISTORY);
        return UNKNOWN_LIGHT;
    }
#endif
    return light;
}

void store(ivec2 pixel, vec4 diffuse, vec4 specular) {
#ifdef TARN_LAST_STEP
    diffuse = vec4(diffuse.xyz, 1.0f);
    specular = vec4(specular.xyz * load_layer_share(pixel), 1.0f);
#endif
    imageStore(out_diffuse, pixel, diffuse);
    imageStore(out_specular, pixel, specular);
}

#ifdef TARN_FIRST_STEP
void keep(ivec2 pixel, vec4 diffuse, vec4 specular) {
    imageStore(kept_diffuse, pixel, diffuse);
    imageStore(kept_specular, pixel, specular);
}
#endif

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (is_outside(pixel)) return;
    vec4 packed_guide = texelFetch(in_guide, pixel, 0);
    Guide guide = unpack_guide(packed_guide);
    vec4 diffuse = texelFetch(in_diffuse, pixel, 0);
    vec4 specular = texelFetch(in_specular, pixel, 0);
    if (guide.alpha < 0.0f) {
        store(pixel, UNKNOWN_LIGHT, UNKNOWN_LIGHT);
#ifdef TARN_FIRST_STEP
        keep(pixel, UNKNOWN_LIGHT, UNKNOWN_LIGHT);
#endif
        return;
    }
    Centre centre = load_centre(pixel, guide, diffuse, specular);
    bvec2 known = bvec2(is_known(diffuse), is_known(specular));
    Mean base = no_mean();
    Mean layer = no_mean();
    add(base, diffuse, known.x ? centre_weight() : 0.0f, 0.0f);
    add(layer, specular, known.y ? centre_weight() : 0.0f, 0.0f);
    add_taps(base, layer, centre, known);
    vec2 frames = unpack_history_tag(packed_guide.w).frames;
    vec4 new_diffuse = sanitize(finish(base, frames.x));
    vec4 new_specular = sanitize(finish(layer, frames.y));
#ifdef TARN_FIRST_STEP
    keep(pixel, frames.x < FEW_FRAMES ? diffuse : new_diffuse,
         frames.y < FEW_FRAMES ? specular : new_specular);
#endif
    store(pixel, new_diffuse, new_specular);
}
