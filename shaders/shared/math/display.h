// From linear radiance to what a screen shows: exposure, a tone curve, sRGB. The window and the PNG files
// both run this text.
#pragma once

#include "shared/dialect.h"

SHARED_BEGIN

// Tone curves. Values are those of ToneCurve (core/display.h).
CONSTANT uint TONE_CLIP = 0u;     // none: what is brighter than 1 is cut off, each channel by itself
CONSTANT uint TONE_NEUTRAL = 1u;  // map_tone_neutral

CONSTANT float BRIGHTEST_EXPOSED = 1e9f;  // white after tone mapping, far from overflow

// The sRGB transfer function (IEC 61966-2-1) of a linear value; continues below 0 linearly.
FN float srgb_from_linear(float linear) {
    return linear <= 0.0031308f ? 12.92f * linear : 1.055f * pow(linear, 1.0f / 2.4f) - 0.055f;
}

// Its inverse.
FN float linear_from_srgb(float encoded) {
    return encoded <= 0.04045f ? encoded / 12.92f : pow((encoded + 0.055f) / 1.055f, 2.4f);
}

FN vec3 srgb_from_linear3(vec3 linear) {
    return vec3(srgb_from_linear(linear.x), srgb_from_linear(linear.y), srgb_from_linear(linear.z));
}

// Khronos PBR Neutral tone mapping of linear Rec. 709 radiance (Khronos Group, "PBR Neutral Tone Mapper
// Specification", 2024): colours up to 0.8 keep hue and saturation, brighter ones are compressed towards
// white.
FN vec3 map_tone_neutral(vec3 rgb) {
    const float FRESNEL =
        0.04f;  // the white glare of a dielectric, taken off so that base colours stay as given
    const float COMPRESSION_START = 0.8f - FRESNEL;
    const float DESATURATION = 0.15f;
    float darkest = min(rgb.x, min(rgb.y, rgb.z));
    float offset = darkest < 2.0f * FRESNEL ? darkest - darkest * darkest / (4.0f * FRESNEL) : FRESNEL;
    vec3 mapped = rgb - vec3(offset);
    float peak = max(mapped.x, max(mapped.y, mapped.z));
    if (peak < COMPRESSION_START) return mapped;
    float headroom = 1.0f - COMPRESSION_START;
    float compressed_peak = 1.0f - headroom * headroom / (peak + headroom - COMPRESSION_START);
    float colour = 1.0f / (DESATURATION * (peak - compressed_peak) + 1.0f);
    return vec3(compressed_peak) + (mapped * (compressed_peak / peak) - vec3(compressed_peak)) * colour;
}

// One channel of exposed radiance, made fit for tone mapping: negative values and NaN become 0.
FN float limit_exposed(float exposed) {
    return exposed > 0.0f ? min(exposed, BRIGHTEST_EXPOSED) : 0.0f;
}

// Radiance times `exposure_scale` (2^EV), fit for tone mapping.
FN vec3 expose(vec3 radiance, float exposure_scale) {
    vec3 exposed = radiance * exposure_scale;
    return vec3(limit_exposed(exposed.x), limit_exposed(exposed.y), limit_exposed(exposed.z));
}

// Display-encoded colour in [0, 1] of exposed radiance by a tone curve TONE_*.
FN vec3 encode_exposed(vec3 exposed, uint tone) {
    vec3 mapped = exposed;
    if (tone == TONE_NEUTRAL) mapped = map_tone_neutral(exposed);
    return clamp(srgb_from_linear3(mapped), vec3(0.0f), vec3(1.0f));
}

SHARED_END
