// Lights each pixel with its path sample, base and layer apart. Where the last step of reuse summed the light of all its
// samples there is nothing left to do, and this pass does not run.
//
// TARN_RESERVOIR_VISIBILITY: visibility is what the reservoir knows; else a ray was traced for it.
#include "shared/interface/constants/shade.h"
#include "lib/scene_buffers.glsl"
#include "lib/frame.glsl"
#include "lib/gbuffer.glsl"
#include "lib/receiver.glsl"
#include "lib/indirect/path_samples.glsl"
#include "lib/reuse/reservoirs.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

layout(binding = UNIT_PASS_A) uniform usamplerBuffer reservoirs;
layout(binding = UNIT_PASS_B) uniform samplerBuffer visibility;
layout(binding = 0, rgba32f) writeonly uniform image2D diffuse_image;
layout(binding = 1, rgba32f) writeonly uniform image2D specular_image;

float load_visibility(ivec2 pixel, Reservoir state) {
#ifdef TARN_RESERVOIR_VISIBILITY
    return state.visibility;
#else
    return texelFetch(visibility, int(pixel_index(pixel))).x;
#endif
}

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (is_outside(pixel)) return;
    BrdfValue light = no_reflection();
    Receiver receiver;
    if (load_receiver(pixel, receiver)) {
        SampleReservoir r = load_reservoir(reservoirs, pixel);
        float factor = r.state.contribution_weight * load_visibility(pixel, r.state);
        light = scale_parts(reflect_sample(receiver, r.chosen), vec3(factor));
    }
    imageStore(diffuse_image, pixel, vec4(light.diffuse, 1.0f));
    imageStore(specular_image, pixel, vec4(light.specular, 1.0f));
}
