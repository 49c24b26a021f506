// Drops reservoirs that carry far more weight than their neighbourhood: those few that reuse would spread as blotches
// that boil. What it drops is energy: the picture darkens where the light is rare.
//
// The neighbourhood is the group of 8 x 8 pixels, the yardstick the mean of its weights (target x contribution weight)
// over reservoirs that hold a sample.
// SAMPLE_ROWS: rows of a sample behind its reservoir's own.
#include "shared/math/reservoir.h"

// The same memory: a pixel reads its own rows, before it writes one of them.
layout(binding = UNIT_PASS_A) uniform usamplerBuffer in_reservoirs;
layout(std430, binding = 0) writeonly buffer Reservoirs { uvec4 out_reservoirs[]; };

const uint GROUP_PIXELS = 64u;
shared float group_weights[GROUP_PIXELS];

// In a fixed order, so that the bits do not depend on the machine.
float group_mean() {
    float sum = 0.0f;
    float count = 0.0f;
    for (uint i = 0u; i < GROUP_PIXELS; ++i) {
        sum += group_weights[i];
        count += group_weights[i] > 0.0f ? 1.0f : 0.0f;
    }
    return count > 0.0f ? sum / count : 0.0f;
}

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    bool inside = !is_outside(pixel);
    uint row = inside ? pixel_index(pixel) * (RESERVOIR_ROWS + SAMPLE_ROWS) : 0u;
    Reservoir r =
        unpack_reservoir(texelFetch(in_reservoirs, int(row)), texelFetch(in_reservoirs, int(row + 1u)));
    float weight = inside ? r.target * r.contribution_weight : 0.0f;
    group_weights[gl_LocalInvocationIndex] = weight;
    barrier();
    // W is the head's last word (pack_reservoir). The confidence stays: that many candidates were looked at.
    if (weight > limit * group_mean()) out_reservoirs[row].w = floatBitsToUint(0.0f);
}
