// Lights each pixel with its reservoir's sample: BRDF x Le x G x visibility x contribution weight, base and layer apart
// and the base without its albedo. composite.comp joins them.
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
#include "lib/receiver.glsl"
#include "lib/direct/light_samples.glsl"
#include "lib/reuse/reservoirs.glsl"
#include "lib/pixel_group.glsl"

#ifdef TARN_SHADED
layout(binding = UNIT_PASS_A) uniform sampler2D summed_diffuse;
layout(binding = UNIT_PASS_B) uniform sampler2D summed_specular;
#else
layout(binding = UNIT_PASS_A) uniform usamplerBuffer reservoirs;
layout(binding = UNIT_PASS_B) uniform samplerBuffer visibility;
#endif
layout(binding = 0, rgba32f) uniform image2D diffuse_image;
layout(binding = 1, rgba32f) uniform image2D specular_image;

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

BrdfValue chosen_light(ivec2 pixel, Receiver receiver) {
    SampleReservoir r = load_reservoir(reservoirs, pixel);
    float visible = load_visibility(pixel, r.state);
    BrdfValue light =
        scale_parts(reflect_sample(receiver, r.chosen), vec3(r.state.contribution_weight * visible));
#ifdef TARN_SHOW_VISIBILITY
    light = BrdfValue(vec3(0.0f), vec3(holds_sample(r) ? visible : 0.0f));
#endif
#ifdef TARN_SHOW_SAMPLES
    light = BrdfValue(vec3(0.0f), holds_sample(r) ? sample_colour(r.chosen) : vec3(0.0f));
#endif
    return light;
}
#endif

BrdfValue direct_light(ivec2 pixel, Receiver receiver) {
#ifdef TARN_SHADED
    BrdfValue light =
        BrdfValue(texelFetch(summed_diffuse, pixel, 0).xyz, texelFetch(summed_specular, pixel, 0).xyz);
#else
    BrdfValue light = chosen_light(pixel, receiver);
#endif
#ifdef TARN_ONE_CHANNEL
    return scale_parts(light, target_weights.xyz * share);
#else
    return scale_parts(light, vec3(share));
#endif
}

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (is_outside(pixel)) return;
    Receiver receiver;
    BrdfValue light = no_reflection();
    if (load_receiver(pixel, receiver)) light = direct_light(pixel, receiver);
#ifdef TARN_ADD
    light.diffuse += imageLoad(diffuse_image, pixel).xyz;
    light.specular += imageLoad(specular_image, pixel).xyz;
#endif
    imageStore(diffuse_image, pixel, vec4(light.diffuse, 1.0f));
    imageStore(specular_image, pixel, vec4(light.specular, 1.0f));
}
