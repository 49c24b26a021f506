// Lights each pixel with its path sample, base and layer apart.
//
// TARN_SHADED: with the light that the last step of reuse has summed over all its samples instead.
// TARN_RESERVOIR_VISIBILITY: visibility is what the reservoir knows; else a ray was traced for it.
// TARN_ONE_CHANNEL: the sample stands for the channel of `target_weights` alone. TARN_ADD: to what is there already.
// TARN_SHOW_PATHS: what the sample is like instead of its light, by `view`.
#include "shared/interface/constants/shade.h"
#include "lib/scene_buffers.glsl"
#include "lib/frame.glsl"
#include "lib/gbuffer.glsl"
#include "lib/receiver.glsl"
#include "lib/indirect/path_samples.glsl"
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
#ifdef TARN_RESERVOIR_VISIBILITY
    return state.visibility;
#else
    return texelFetch(visibility, int(pixel_index(pixel))).x;
#endif
}

// What a sample is like, as a colour: directions from -1 to 1 become 0 to 1, metres, frames and weights are grey.
vec3 show_path(Receiver receiver, SampleReservoir r) {
    IncidentLight light = place_light(r.chosen.path, r.chosen.place, receiver.point.position);
    vec3 to_place = r.chosen.place.position - receiver.point.position;
    if (!holds_sample(r)) return vec3(0.0f);
    if (view == PATH_VIEW_DIRECTION) return 0.5f + 0.5f * normalize(to_place);
    if (view == PATH_VIEW_DISTANCE) return vec3(length(to_place));
    if (view == PATH_VIEW_NORMAL) return 0.5f + 0.5f * r.chosen.path.shading_normal;
    if (view == PATH_VIEW_RADIANCE) return light.value;
    if (view == PATH_VIEW_WEIGHT) return vec3(r.state.contribution_weight);
    return vec3(r.state.age);
}

BrdfValue chosen_light(ivec2 pixel, Receiver receiver) {
    SampleReservoir r = load_reservoir(reservoirs, pixel);
#ifdef TARN_SHOW_PATHS
    return BrdfValue(vec3(0.0f), show_path(receiver, r));
#else
    float factor = r.state.contribution_weight * load_visibility(pixel, r.state);
    return scale_parts(reflect_sample(receiver, r.chosen), vec3(factor));
#endif
}
#endif

BrdfValue indirect_light(ivec2 pixel, Receiver receiver) {
#ifdef TARN_SHADED
    BrdfValue light =
        BrdfValue(texelFetch(summed_diffuse, pixel, 0).xyz, texelFetch(summed_specular, pixel, 0).xyz);
#else
    BrdfValue light = chosen_light(pixel, receiver);
#endif
#ifdef TARN_ONE_CHANNEL
    light = scale_parts(light, target_weights.xyz);
#endif
    return light;
}

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (is_outside(pixel)) return;
    BrdfValue light = no_reflection();
    Receiver receiver;
    if (load_receiver(pixel, receiver)) light = indirect_light(pixel, receiver);
#ifdef TARN_ADD
    light.diffuse += imageLoad(diffuse_image, pixel).xyz;
    light.specular += imageLoad(specular_image, pixel).xyz;
#endif
    imageStore(diffuse_image, pixel, vec4(light.diffuse, 1.0f));
    imageStore(specular_image, pixel, vec4(light.specular, 1.0f));
}
