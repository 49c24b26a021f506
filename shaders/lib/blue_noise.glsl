// Blue noise as shaders read it. After lib/frame.glsl.
#include "shared/math/blue_noise.h"

layout(binding = UNIT_PASS_A) uniform usamplerBuffer blue_noise_mask;

uint fetch_blue_noise(uint index) { return texelFetch(blue_noise_mask, int(index)).x; }

#include "shared/scene/blue_noise.h"
