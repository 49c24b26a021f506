// Tells each fresh sample whether its pixel sees it. With `discard_occluded` an occluded one is dropped, its confidence
// kept: visibility reuse of Bitterli et al. 2020, section 4.2.
// SAMPLE_ROWS: rows of a sample behind its reservoir's own.
#include "shared/math/reservoir.h"

layout(std430, binding = 0) buffer Reservoirs { uvec4 reservoirs[]; };
layout(binding = UNIT_PASS_A) uniform samplerBuffer visibility;

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (is_outside(pixel)) return;
    uint row = pixel_index(pixel) * (RESERVOIR_ROWS + SAMPLE_ROWS);
    float visible = texelFetch(visibility, int(pixel_index(pixel))).x;
    // W is the head's last word, visibility the state's third (pack_reservoir). Nothing is read back.
    reservoirs[row + 1u].z = floatBitsToUint(visible);
    if (visible == 0.0f && discard_occluded != 0u) reservoirs[row].w = floatBitsToUint(0.0f);
}
