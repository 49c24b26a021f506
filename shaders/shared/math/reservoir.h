// Weighted reservoirs: one sample kept out of a stream, each with probability in proportion to its resampling
// weight.
//
// Source: Bitterli et al., "Spatiotemporal Reservoir Resampling for Real-Time Ray Tracing with Dynamic Direct
// Lighting", 2020, algorithms 2 and 3; names as in Lin et al., "Generalized Resampled Importance Sampling",
// 2022. A LiveReservoir is being filled; a Reservoir is finished and carries the contribution weight W, an
// unbiased estimate of 1 / pdf of its sample. What a sample is, reservoirs do not know: whoever fills one
// keeps the sample beside it (light_sample.h for direct light) and replaces it where an offer is OFFER_TAKEN.
#pragma once

#include "shared/dialect.h"
#include "shared/math/packing.h"

SHARED_BEGIN

struct LiveReservoir {
    float target;      // target function (p-hat) at the chosen sample
    float weight_sum;  // sum of all resampling weights so far
};

struct Reservoir {
    float contribution_weight;  // W; 0: the reservoir holds no sample
    float confidence;           // M, in candidates
    float target;               // p-hat of its pixel at the chosen sample, when W was found
    float visibility;  // of the chosen sample from its pixel, or an estimate of it (V-bar); 1 until traced
    float age;         // frames since the chosen sample was drawn
};

FN LiveReservoir empty_live_reservoir() {
    LiveReservoir r;
    r.target = 0.0f;
    r.weight_sum = 0.0f;
    return r;
}

FN Reservoir empty_reservoir() {
    Reservoir r;
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

// What became of a candidate.
CONSTANT uint OFFER_PASSED = 0u;  // the sample stays what it was
CONSTANT uint OFFER_TAKEN = 1u;   // the candidate is the sample now
CONSTANT uint OFFER_BAD = 2u;     // its weight was negative or not finite: to be counted by the caller

// Offers a candidate with resampling weight w = m * target / pdf. `u` in [0, 1). A weight that is 0 or
// subnormal, negative or not finite is passed over. Returns one of OFFER_*.
FN uint offer_candidate(INOUT(LiveReservoir) r, float target, float weight, float u) {
    if (!is_finite(weight) || weight < 0.0f) return OFFER_BAD;
    if (weight < LEAST_WEIGHT || target < LEAST_WEIGHT) return OFFER_PASSED;
    r.weight_sum += weight;
    // By product, not by quotient: no 0/0, and the first candidate is always taken.
    if (!(u * r.weight_sum < weight)) return OFFER_PASSED;
    r.target = target;
    return OFFER_TAKEN;
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
    r.contribution_weight = weight;
    r.target = live.target;
    return r;
}

// Two rows: the head, whose first three words are the sample's, and the state. Samples that need more than
// three words have rows of their own behind these (shaders/lib/reuse/reservoirs.glsl).
CONSTANT uint RESERVOIR_ROWS = 2u;

FN void pack_reservoir(Reservoir r, uvec3 sample_words, OUT(uvec4) head, OUT(uvec4) state) {
    head = uvec4(sample_words.x, sample_words.y, sample_words.z, floatBitsToUint(r.contribution_weight));
    state = pack_row4(vec4(r.confidence, r.target, r.visibility, r.age));
}

FN Reservoir unpack_reservoir(uvec4 head, uvec4 state) {
    Reservoir r;
    r.contribution_weight = uintBitsToFloat(head.w);
    r.confidence = uintBitsToFloat(state.x);
    r.target = uintBitsToFloat(state.y);
    r.visibility = uintBitsToFloat(state.z);
    r.age = uintBitsToFloat(state.w);
    return r;
}

SHARED_END
