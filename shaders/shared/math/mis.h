// Weights of multiple importance sampling for a reuse step: a pixel (the canonical technique) and its
// neighbours each offer one sample; the weights of all techniques sum to 1 at every sample that the pixel's
// target can see.
//
// Here a technique is known by its confidence M and by its target (p-hat) at the sample in question, moved
// into the pixel's domain and 0 where the technique could not have made that sample. Neighbours that were
// rejected are no techniques and take no part.
//
// Sources: Bitterli et al. 2020, section 4.3 and algorithm 6 (1/M, 1/Z); Talbot 2005 with confidence
// weights, Lin et al. 2022 and equation 3 of Tokuyoshi's supplement (balance); Bitterli 2022 and Lin et al.
// 2022 (pairwise, in its defensive form).
#pragma once

#include "shared/dialect.h"

SHARED_BEGIN

// Every technique counts, whether it could have made the sample or not: biased.
CONSTANT uint MIS_ONE_OVER_M = 0u;
// Only those count that could have made it.
CONSTANT uint MIS_ONE_OVER_Z = 1u;
// Generalized balance heuristic: by confidence * target.
CONSTANT uint MIS_BALANCE = 2u;
// Each neighbour against the pixel alone, a share of which is always its own (defensive).
CONSTANT uint MIS_PAIRWISE = 3u;

// a / b for 0 <= a <= b; 0 where b is 0.
FN float bounded_ratio(float a, float b) {
    return b > 0.0f ? min(a / b, 1.0f) : 0.0f;
}

// What one technique adds to Z.
FN float z_term(float confidence, float target) {
    return target > 0.0f ? confidence : 0.0f;
}

// What one technique adds to the denominator of the balance heuristic; its weight is its own term / their
// sum.
FN float balance_term(float confidence, float target) {
    return confidence * target;
}

// What all pairs of one step have in common.
struct PairwiseStep {
    float canonical_confidence;
    float neighbour_confidence;  // of all neighbours together
};

// Weight of a neighbour for a sample. `confidence` and `target` are the neighbour's.
FN float pairwise_neighbour_weight(PairwiseStep step, float confidence, float target,
                                   float canonical_target) {
    float total = step.canonical_confidence + step.neighbour_confidence;
    float theirs = step.neighbour_confidence * target;
    float ours = step.canonical_confidence * canonical_target;
    return bounded_ratio(confidence, total) * bounded_ratio(theirs, theirs + ours);
}

// What the pair with one neighbour adds to the canonical weight.
FN float pairwise_canonical_term(PairwiseStep step, float confidence, float target, float canonical_target) {
    float total = step.canonical_confidence + step.neighbour_confidence;
    float theirs = step.neighbour_confidence * target;
    float ours = step.canonical_confidence * canonical_target;
    return bounded_ratio(confidence, total) * bounded_ratio(ours, theirs + ours);
}

// The share of the canonical technique that no neighbour touches (defensive).
FN float pairwise_defensive_share(PairwiseStep step) {
    return bounded_ratio(step.canonical_confidence, step.canonical_confidence + step.neighbour_confidence);
}

// ---- Rays of a step
// -----------------------------------------------------------------------------------------------

// Shadow rays a pixel needs, with `neighbours` of them: those of the MIS denominators, or, without these, one
// a neighbour where the visibility of its sample is to be known (`sample_visibility`).
FN uint reuse_ray_count(uint mis, bool mis_visibility, bool sample_visibility, uint neighbours) {
    if (!mis_visibility || mis == MIS_ONE_OVER_M) return sample_visibility ? neighbours : 0u;
    if (mis == MIS_ONE_OVER_Z) return neighbours + 1u;  // every technique to the chosen sample
    if (mis == MIS_PAIRWISE) return 2u * neighbours;
    return neighbours * (neighbours + 1u);  // every technique to every sample but its own
}

// Place of the ray from the pixel to the sample of neighbour `n` (1 for the first).
FN uint canonical_ray_slot(uint mis, bool mis_visibility, uint neighbours, uint n) {
    if (!mis_visibility || mis == MIS_ONE_OVER_M) return n - 1u;
    if (mis == MIS_PAIRWISE) return 2u * (n - 1u);
    return n * neighbours;
}

// Place of the ray from technique `technique` to the sample of technique `sampled`; 0 is the pixel, and the
// two differ.
FN uint technique_ray_slot(uint mis, uint neighbours, uint sampled, uint technique) {
    if (mis == MIS_PAIRWISE) return technique == 0u ? 2u * (sampled - 1u) : 2u * (technique - 1u) + 1u;
    return sampled * neighbours + (technique < sampled ? technique : technique - 1u);
}

SHARED_END
