// A light sample: a place on a light, independent of who looks at it. What direct light resamples.
#pragma once

#include "shared/dialect.h"

SHARED_BEGIN

struct LightSample {
    uint light;  // index, LIGHT_ENVIRONMENT or INVALID_INDEX
    vec2 uv;     // triangle: barycentrics; environment: octahedral direction; punctual: unused
};

// Rows behind those of a reservoir: all of a sample is in the reservoir's head.
CONSTANT uint LIGHT_SAMPLE_ROWS = 0u;

FN LightSample no_light_sample() {
    LightSample none;
    none.light = INVALID_INDEX;
    none.uv = vec2(0.0f);
    return none;
}

FN uvec3 pack_light_sample(LightSample drawn) {
    return uvec3(drawn.light, floatBitsToUint(drawn.uv.x), floatBitsToUint(drawn.uv.y));
}

FN LightSample unpack_light_sample(uvec3 words) {
    LightSample drawn;
    drawn.light = words.x;
    drawn.uv = vec2(uintBitsToFloat(words.y), uintBitsToFloat(words.z));
    return drawn;
}

SHARED_END
