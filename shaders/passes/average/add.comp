// Adds a frame to the mean of frames that show the same, and fades from the picture before them to their mean.
#include "shared/interface/bindings.h"
#include "shared/interface/constants/average.h"
#include "shared/math/average.h"
#include "lib/pixel_group.glsl"

layout(binding = UNIT_PASS_A) uniform sampler2D radiance;
layout(binding = UNIT_PASS_B) uniform sampler2D last_mean;
layout(binding = UNIT_PASS_C) uniform sampler2D picture_before;
layout(binding = 0, rgba32f) writeonly uniform image2D out_mean;
layout(binding = 1, rgba32f) writeonly uniform image2D out_shown;

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    ivec2 size_px = imageSize(out_mean);
    if (pixel.x >= size_px.x || pixel.y >= size_px.y) return;
    vec4 last = frame_count > 0u ? texelFetch(last_mean, pixel, 0) : vec4(0.0f);
    vec4 mean = add_to_mean(last, texelFetch(radiance, pixel, 0).xyz, frame_count);
    vec3 shown = mean.xyz;
    if (has_before != 0u) {
        vec3 before = texelFetch(picture_before, pixel, 0).xyz;
        if (is_finite3(before)) shown = mix(before, shown, share_of_mean(frame_count + 1u));
    }
    imageStore(out_mean, pixel, mean);
    imageStore(out_shown, pixel, vec4(shown, 1.0f));
}
