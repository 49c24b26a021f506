// Joins what the stages of light found: emission + albedo x diffuse light + specular light. The fourth number is 0 where
// it is no light, else 1 + the share of it that the surface emits (antialiasing treats lamps apart).
//
// TARN_INDIRECT: with indirect light.
// TARN_INDIRECT_ALONE: with nothing but it, where a debug view shows its samples.
// TARN_LIGHT_ALONE: without emission, where a debug view shows something else than light.
#include "lib/frame.glsl"
#include "lib/gbuffer.glsl"
#include "lib/counters.glsl"
#include "lib/pixel_group.glsl"

layout(binding = UNIT_PASS_A) uniform sampler2D direct_diffuse;
layout(binding = UNIT_PASS_B) uniform sampler2D direct_specular;
#ifdef TARN_INDIRECT
layout(binding = UNIT_PASS_C) uniform sampler2D indirect_diffuse;
layout(binding = UNIT_PASS_D) uniform sampler2D indirect_specular;
#endif
layout(binding = 0, rgba32f) writeonly uniform image2D out_radiance;

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (is_outside(pixel)) return;
    vec3 diffuse = texelFetch(direct_diffuse, pixel, 0).xyz;
    vec3 specular = texelFetch(direct_specular, pixel, 0).xyz;
#ifdef TARN_INDIRECT_ALONE
    diffuse = vec3(0.0f);
    specular = vec3(0.0f);
#endif
#ifdef TARN_INDIRECT
    diffuse += texelFetch(indirect_diffuse, pixel, 0).xyz;
    specular += texelFetch(indirect_specular, pixel, 0).xyz;
#endif
    vec3 radiance = load_layer(pixel, LAYER_DIFFUSE).xyz * diffuse + specular;
    float emitted = 0.0f;
#ifndef TARN_LIGHT_ALONE
    vec3 emission = load_layer(pixel, LAYER_EMISSION).xyz;
    radiance += emission;
    emitted = clamp(ratio_or_zero(luminance(emission), luminance(radiance)), 0.0f, 1.0f);
#endif
    bool usable = is_finite3(radiance);
    if (!usable) count_event(COUNTER_BAD_RADIANCE);
    imageStore(out_radiance, pixel, usable ? vec4(radiance, 1.0f + emitted) : vec4(0.0f));
}
