// Counts how bright the picture's pixels are: a histogram for each of a few groups, which take rows in turn. Whole
// numbers: the order of the threads changes no bit.
#include "shared/dialect.h"
#include "shared/interface/bindings.h"
#include "shared/math/exposure.h"

layout(local_size_x = 8, local_size_y = 8) in;

layout(binding = UNIT_PASS_A) uniform sampler2D radiance;
layout(std430, binding = 0) writeonly buffer Counts { uint out_counts[]; };  // [group][bin]

const int LANES = 64;

shared uint bin_count[EXPOSURE_BINS];

void main() {
    int lane = int(gl_LocalInvocationIndex);
    int group = int(gl_WorkGroupID.x);
    for (int bin = lane; bin < EXPOSURE_BINS; bin += LANES) bin_count[bin] = 0u;
    barrier();
    ivec2 size_px = textureSize(radiance, 0);
    int stride = exposure_stride(size_px.x, size_px.y);
    for (int y = group * stride; y < size_px.y; y += EXPOSURE_GROUPS * stride) {
        for (int x = lane * stride; x < size_px.x; x += LANES * stride) {
            int bin = exposure_bin(texelFetch(radiance, ivec2(x, y), 0).xyz);
            if (bin >= 0) atomicAdd(bin_count[bin], 1u);
        }
    }
    barrier();
    for (int bin = lane; bin < EXPOSURE_BINS; bin += LANES) {
        out_counts[group * EXPOSURE_BINS + bin] = bin_count[bin];
    }
}
