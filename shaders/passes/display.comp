// One view of the frame as display-encoded colours; which one, the define says (engine/passes/display.cpp). Radiance has
// the size of what is shown; surfaces may be coarser.
#include "shared/interface/constants/display.h"
#include "lib/gbuffer.glsl"
#include "lib/glare.glsl"
#include "shared/math/colour.h"
#include "shared/math/display.h"
#include "shared/math/random.h"
#include "lib/pixel_group.glsl"

layout(binding = UNIT_PASS_A) uniform sampler2D frame_radiance;
layout(binding = UNIT_PASS_B) uniform usampler2D seen_triangles;
layout(binding = UNIT_PASS_C) uniform usamplerBuffer exposure;
layout(binding = UNIT_PASS_D) uniform sampler2D glare;
layout(binding = 0, rgba8) writeonly uniform image2D out_picture;

// Radiance times this is shown.
float exposure_scale() { return uintBitsToFloat(texelFetch(exposure, 0).x); }

// Black, blue, cyan, green, yellow, red, white for t = 0, 1/6 .. 1.
vec3 false_colour(float t) {
    const vec3 RAMP[7] =
        vec3[](vec3(0.0f), vec3(0.0f, 0.0f, 1.0f), vec3(0.0f, 1.0f, 1.0f), vec3(0.0f, 1.0f, 0.0f),
               vec3(1.0f, 1.0f, 0.0f), vec3(1.0f, 0.0f, 0.0f), vec3(1.0f));
    float position = clamp(t, 0.0f, 1.0f) * 6.0f;
    int segment = min(int(position), 5);
    return mix(RAMP[segment], RAMP[segment + 1], position - float(segment));
}

// Directions as colours; nothing seen stays black.
vec3 direction_colour(vec2 octahedral, bool seen) {
    return seen ? decode_octahedral(octahedral) * 0.5f + 0.5f : vec3(0.0f);
}

vec3 primitive_colour(uvec2 seen) {
    uvec4 bits = hash_pcg4d(uvec4(seen, 0u, 0u));
    return vec3(float_from_bits(bits.x), float_from_bits(bits.y), float_from_bits(bits.z)) * 0.8f + 0.2f;
}

vec3 luminance_colour(vec3 radiance) {
    const float MIDDLE_GREY = 0.18f;
    const float STOPS = 8.0f;
    float exposed = luminance(radiance) * exposure_scale() / MIDDLE_GREY;
    return false_colour(exposed > 0.0f ? 0.5f + 0.5f * log2(exposed) / STOPS : 0.0f);
}

// 1 nm to 1 mm; negative where nothing is to be lit.
vec3 position_error_colour(float error_m) {
    const float DECADES = 6.0f;
    return false_colour(error_m > 0.0f ? (log2(error_m) / log2(10.0f) + 9.0f) / DECADES : 0.0f);
}

vec3 load_exposed(ivec2 shown) {
    vec3 exposed = expose(texelFetch(frame_radiance, shown, 0).xyz, exposure_scale());
#ifdef TARN_GLARE
    int levels = count_glare_levels(int(width_px), int(height_px));
    exposed = add_glare(exposed, load_enlarged(glare, shown), levels, glare_strength);
#endif
    return exposed;
}

vec4 load_shown(ivec2 pixel, int layer) {
    return load_layer_of(uint(textureSize(seen_triangles, 0).x), pixel, layer);
}

vec3 view_colour(ivec2 shown) {
    ivec2 pixel = shown * textureSize(seen_triangles, 0) / ivec2(width_px, height_px);
    uvec2 seen = texelFetch(seen_triangles, pixel, 0).xy;
    bool is_seen = seen.x != INVALID_INDEX;
#if defined(TARN_VIEW_LUMINANCE)
    return luminance_colour(texelFetch(frame_radiance, shown, 0).xyz);
#elif defined(TARN_VIEW_ALBEDO)
    return srgb_from_linear3(load_shown(pixel, LAYER_DIFFUSE).xyz + load_shown(pixel, LAYER_SPECULAR).xyz);
#elif defined(TARN_VIEW_EMISSION)
    return encode_exposed(expose(load_shown(pixel, LAYER_EMISSION).xyz, exposure_scale()), tone);
#elif defined(TARN_VIEW_GEOMETRIC_NORMALS)
    return direction_colour(load_shown(pixel, LAYER_NORMALS).xy, is_seen);
#elif defined(TARN_VIEW_SHADING_NORMALS)
    return direction_colour(load_shown(pixel, LAYER_NORMALS).zw, is_seen);
#elif defined(TARN_VIEW_POSITION_ERROR)
    return position_error_colour(load_shown(pixel, LAYER_POSITION).w);
#elif defined(TARN_VIEW_PRIMITIVES)
    return is_seen ? primitive_colour(seen) : vec3(0.0f);
#else
    return encode_exposed(load_exposed(shown), tone);
#endif
}

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (pixel.x >= int(width_px) || pixel.y >= int(height_px)) return;
    imageStore(out_picture, pixel, vec4(view_colour(pixel), 1.0f));
}
