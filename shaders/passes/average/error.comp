// Sums over the mean of frames: each thread takes some of the pixels. The CPU adds the threads up, in their order.
#include "shared/interface/bindings.h"
#include "shared/interface/constants/average.h"
#include "shared/math/average.h"

layout(local_size_x = 8, local_size_y = 8) in;

layout(binding = UNIT_PASS_A) uniform sampler2D mean_picture;
layout(std430, binding = 0) writeonly buffer Sums { uvec4 out_sums[]; };  // variance, luminance, pixels

void main() {
    int threads = int(gl_NumWorkGroups.x) * 64;
    int thread = int(gl_WorkGroupID.x) * 64 + int(gl_LocalInvocationIndex);
    ivec2 size_px = textureSize(mean_picture, 0);
    float variance = 0.0f;
    float light = 0.0f;
    uint pixels = 0u;
    for (int i = thread; i < size_px.x * size_px.y; i += threads) {
        vec4 mean = texelFetch(mean_picture, ivec2(i % size_px.x, i / size_px.x), 0);
        variance += variance_of_mean(mean, frame_count);
        light += luminance(mean.xyz);
        ++pixels;
    }
    out_sums[thread] = uvec4(floatBitsToUint(variance), floatBitsToUint(light), pixels, 0u);
}
