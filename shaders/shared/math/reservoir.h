// Weighted reservoirs: one sample kept out of a stream, each with probability in proportion to its resampling
// weight.
//
// Source: Bitterli et al., "Spatiotemporal Reservoir Resampling for Real-Time Ray Tracing with Dynamic Direct
// Lighting", 2020, algorithms 2 and 3; names as in Lin et al., "Generalized Resampled Importance Sampling",
// 2022. A LiveReservoir is being filled; a Reservoir is finished and carries the contribution weight W, an
// unbiased estimate of 1 / pdf of its sample.
#pragma once

#include "shared/dialect.h"
#include "shared/math/packing.h"

SHARED_BEGIN

// A place on a light, independent of who looks at it.
struct LightSample {
    uint light;  // index, LIGHT_ENVIRONMENT or INVALID_INDEX
    vec2 uv;     // triangle: barycentrics; environment: octahedral direction; punctual: unused
};

struct LiveReservoir {
    LightSample chosen;
    float target;      // target function (p-hat) at the chosen sample
    float weight_sum;  // sum of all resampling weights so far
};

struct Reservoir {
    LightSample chosen;
    float contribution_weight;  // W; 0: the reservoir holds nothing
    float confidence;           // M, in candidates
    float target;               // p-hat of its pixel at the chosen sample, when W was found
    float visibility;  // of the chosen sample from its pixel, or an estimate of it (V-bar); 1 until traced
    float age;         // frames since the chosen sample was drawn
};

FN LightSample no_light_sample() {
    LightSample none;
    none.light = INVALID_INDEX;
    none.uv = vec2(0.0f);
    return none;
}

FN LiveReservoir empty_live_reservoir() {
    LiveReservoir r;
    r.chosen = no_light_sample();
    r.target = 0.0f;
    r.weight_sum = 0.0f;
    return r;
}

FN Reservoir empty_reservoir() {
    Reservoir r;
    r.chosen = no_light_sample();
    r.contribution_weight = 0.0f;
    r.confidence = 0.0f;
    r.target = 0.0f;
    r.visibility = 1.0f;
    r.age = 0.0f;
    return r;
}

// Weights and targets below the least normal float are no light: arithmetic on them loses digits or, where a
// thread flushes them to 0, everything.
CONSTANT float LEAST_WEIGHT = 1.17549435e-38f;

// Offers a candidate with resampling weight w = m * target / pdf. `u` in [0, 1). A weight that is 0 or
// subnormal, negative or not finite is passed over; returns false for the last two, so that the caller can
// count them.
FN bool offer_candidate(INOUT(LiveReservoir) r, LightSample candidate, float target, float weight, float u) {
    if (!is_finite(weight) || weight < 0.0f) return false;
    if (weight < LEAST_WEIGHT || target < LEAST_WEIGHT) return true;
    r.weight_sum += weight;
    // By product, not by quotient: no 0/0, and the first candidate is always taken.
    if (u * r.weight_sum < weight) {
        r.chosen = candidate;
        r.target = target;
    }
    return true;
}

// Whether W of what was offered leaves float's range.
FN bool has_overflown(LiveReservoir live) {
    return !is_finite(ratio_or_zero(live.weight_sum, live.target));
}

// W = weight_sum / target. `confidence`: candidates seen. A weight that is not finite leaves no sample, but
// confidence: that many candidates were looked at and it is their sum that was lost.
FN Reservoir finish_reservoir(LiveReservoir live, float confidence) {
    Reservoir r = empty_reservoir();
    r.confidence = confidence;
    float weight = ratio_or_zero(live.weight_sum, live.target);
    if (!is_finite(weight) || weight < LEAST_WEIGHT) return r;
    r.chosen = live.chosen;
    r.contribution_weight = weight;
    r.target = live.target;
    return r;
}

CONSTANT uint RESERVOIR_ROWS = 2u;

FN void pack_reservoir(Reservoir r, OUT(uvec4) row0, OUT(uvec4) row1) {
    row0 = uvec4(r.chosen.light, floatBitsToUint(r.chosen.uv.x), floatBitsToUint(r.chosen.uv.y),
                 floatBitsToUint(r.contribution_weight));
    row1 = pack_row4(vec4(r.confidence, r.target, r.visibility, r.age));
}

FN Reservoir unpack_reservoir(uvec4 row0, uvec4 row1) {
    Reservoir r;
    r.chosen.light = row0.x;
    r.chosen.uv = vec2(uintBitsToFloat(row0.y), uintBitsToFloat(row0.z));
    r.contribution_weight = uintBitsToFloat(row0.w);
    r.confidence = uintBitsToFloat(row1.x);
    r.target = uintBitsToFloat(row1.y);
    r.visibility = uintBitsToFloat(row1.z);
    r.age = uintBitsToFloat(row1.w);
    return r;
}

SHARED_END
