// What antialiasing over time computes of single values: weights of samples, and which colours of the past
// the present explains. No scene, no pictures.
#pragma once

#include "shared/dialect.h"
#include "shared/math/colour.h"

SHARED_BEGIN

// ---- Weights

// Weight of a sample at `offset` from the centre of a pixel, in pixels of the picture: 1 there, 0 from
// one pixel on. Its spread is nearly that of the box of a pixel (1/8 of a squared pixel an axis against
// 1/12).
FN float sample_weight(vec2 offset) {
    float rest = max(0.0f, 1.0f - dot(offset, offset));
    return rest * rest;
}

// The same of bilinear interpolation; `offset` in the samples' own pixels.
FN float tent_weight(vec2 offset) {
    return max(0.0f, 1.0f - abs(offset.x)) * max(0.0f, 1.0f - abs(offset.y));
}

// Weights of four pixels in a row for the place `share` of the way from the second to the third: the cubic of
// Keys ("Cubic Convolution Interpolation for Digital Image Processing", 1981). SHARPNESS is 0.5 for Catmull
// and Rom's; with 0.65 waves of five pixels, read again in every frame, keep their height and place best.
FN vec4 cubic_weights(float share) {
    const float SHARPNESS = 0.65f;
    float s = share;
    float r = 1.0f - share;
    vec2 inner = vec2(((2.0f - SHARPNESS) * s - (3.0f - SHARPNESS)) * s * s + 1.0f,
                      ((2.0f - SHARPNESS) * r - (3.0f - SHARPNESS)) * r * r + 1.0f);
    return vec4(-SHARPNESS * s * r * r, inner.x, inner.y, -SHARPNESS * r * s * s);
}

// ---- Colours as the eye weighs them

// Radiance over key + luminance (Reinhard; Karis, "High-Quality Temporal Supersampling", 2014), in YCoCg.
FN vec3 compress_colour(vec3 radiance, float key) {
    vec3 c = radiance * (1.0f / (key + luminance(radiance)));
    return vec3(0.25f * c.x + 0.5f * c.y + 0.25f * c.z, 0.5f * (c.x - c.z), 0.5f * c.y - 0.25f * (c.x + c.z));
}

// The radiance again; colours that no radiance has become the nearest one that is not negative.
FN vec3 expand_colour(vec3 ycocg, float key) {
    const float BRIGHTEST = 0.99999f;
    float rest = ycocg.x - ycocg.z;
    vec3 c = max(vec3(rest + ycocg.y, ycocg.x + ycocg.z, rest - ycocg.y), vec3(0.0f));
    return c * (key / (1.0f - min(luminance(c), BRIGHTEST)));
}

// How many times `colour` is farther from `mean` than the box of `half_size` around it reaches; 1 at most
// inside (Salvi, "An Excursion in Temporal Supersampling", 2016).
FN float box_excess(vec3 colour, vec3 mean, vec3 half_size) {
    vec3 offset = abs(colour - mean);
    return max(1.0f, max_component(offset / half_size));
}

// How many times a sample may exceed all around it without being a lamp. In lantern_court without a denoiser
// 30 would drop 1.4 % of the energy.
CONSTANT float STRAY_RATIO = 100.0f;

// Among black pixels nothing stands out.
FN bool exceeds_all_around(vec3 radiance, float greatest_around) {
    return greatest_around > 0.0f && luminance(radiance) > STRAY_RATIO * greatest_around;
}

// ---- The past

// Samples that stand behind a pixel: it grows by `weight`, and above `steady` half as fast, so that what was
// known before fades; up to `greatest`.
FN float add_to_count(float count, float weight, float steady, float greatest) {
    return min(greatest, min(count + weight, max(steady, count + 0.5f * weight)));
}

SHARED_END
