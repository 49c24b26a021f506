// Lights each pixel with its reservoir's sample: emission + BRDF x Le x G x visibility x contribution weight.
//
// TARN_SHADED: with the light that the last step of reuse has summed over all its samples instead.
// TARN_RESERVOIR_VISIBILITY: visibility is what the reservoir knows; else a ray was traced for it.
// TARN_SHOW_VISIBILITY: the visibility term itself instead of light; TARN_SHOW_UNSHADOWED: light without it. Figures 1c,
// 1d and 1e of Tokuyoshi's supplement. TARN_SHOW_SAMPLES: a colour for each light sample; pixels of one colour share it.
// TARN_ONE_CHANNEL: the sample stands for the channel of `target_weights` alone. TARN_ADD: to what is there already.
#include "shared/interface/constants/shade.h"
#include "lib/scene_buffers.glsl"
#include "lib/frame.glsl"
#include "lib/gbuffer.glsl"
#include "lib/counters.glsl"
#include "lib/receiver.glsl"
#include "lib/direct/light_samples.glsl"
#include "lib/reuse/reservoirs.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

#ifdef TARN_SHADED
layout(binding = UNIT_PASS_A) uniform sampler2D summed_light;
#else
layout(binding = UNIT_PASS_A) uniform usamplerBuffer reservoirs;
#endif
layout(binding = UNIT_PASS_B) uniform samplerBuffer visibility;
layout(binding = 0, rgba32f) uniform image2D radiance_image;

#ifndef TARN_SHADED
float load_visibility(ivec2 pixel, Reservoir state) {
#ifdef TARN_SHOW_UNSHADOWED
    return 1.0f;
#endif
#ifdef TARN_RESERVOIR_VISIBILITY
    return state.visibility;
#else
    return texelFetch(visibility, int(pixel_index(pixel))).x;
#endif
}

// Never black. Different samples have the same colour once in 2^24.
vec3 sample_colour(LightSample chosen) {
    uvec4 bits = hash_pcg4d(uvec4(chosen.light, floatBitsToUint(chosen.uv), 1u));
    return (vec3(bits.xyz >> 24u) + 1.0f) / 256.0f;
}

vec3 chosen_light(ivec2 pixel, Receiver receiver) {
    SampleReservoir r = load_reservoir(reservoirs, pixel);
    float visible = load_visibility(pixel, r.state);
    vec3 reflected = reflect_sample(receiver, r.chosen) * (r.state.contribution_weight * visible);
#ifdef TARN_SHOW_VISIBILITY
    reflected = vec3(holds_sample(r) ? visible : 0.0f);
#endif
#ifdef TARN_SHOW_SAMPLES
    reflected = holds_sample(r) ? sample_colour(r.chosen) : vec3(0.0f);
#endif
    return reflected;
}
#endif

vec3 direct_light(ivec2 pixel, Receiver receiver) {
#ifdef TARN_SHADED
    vec3 light = texelFetch(summed_light, pixel, 0).xyz;
#else
    vec3 light = chosen_light(pixel, receiver);
#endif
#ifdef TARN_ONE_CHANNEL
    light *= target_weights.xyz;
#endif
    return light * share;
}

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (is_outside(pixel)) return;
#ifdef TARN_ADD
    vec3 radiance = imageLoad(radiance_image, pixel).xyz;
#else
    vec3 radiance = load_layer(pixel, LAYER_EMISSION).xyz;
#if defined(TARN_SHOW_VISIBILITY) || defined(TARN_SHOW_SAMPLES)
    radiance = vec3(0.0f);
#endif
#endif
    Receiver receiver;
    if (load_receiver(pixel, receiver)) radiance += direct_light(pixel, receiver);
    if (!is_finite3(radiance)) {
        count_event(COUNTER_BAD_RADIANCE);
        radiance = vec3(0.0f);
    }
    imageStore(radiance_image, pixel, vec4(radiance, 1.0f));
}
