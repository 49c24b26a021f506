// One step of reuse, over time or over neighbours: what both have in common.
//
// A step may run twice: with TARN_WRITE_RAYS it writes the rays that it needs, then, these traced, it merges. Both
// draw the same random numbers and so speak of the same samples. Pictures are worked off in bands of rows, so that the
// rays of a band fit their buffer. Its constants: shared/interface/constants/reuse.h.
#include "lib/reuse/reservoirs.glsl"
#include "shared/math/mis.h"

// TARN_MIS: one of MIS_*. TARN_MIS_VISIBILITY: whether the MIS denominators ask for visibility.
// TARN_FINAL_VISIBILITY: how the visibility of the chosen sample is known.
#define FINAL_VISIBILITY_TRACED 0    // by a ray after all reuse
#define FINAL_VISIBILITY_REUSED 1    // its own, as traced when it was drawn or taken over from a neighbour
#define FINAL_VISIBILITY_AVERAGED 2  // the weighted mean over all samples of the step (Tokuyoshi, equation 4)

const uint MIS = TARN_MIS;
const bool MIS_VISIBILITY = TARN_MIS_VISIBILITY != 0 && MIS != MIS_ONE_OVER_M;
const bool VISIBILITY_IS_KNOWN = TARN_FINAL_VISIBILITY != FINAL_VISIBILITY_TRACED;
// Whether the weights of all techniques sum to 1 as they are; those of the others are divided by M or Z at the end.
const bool WEIGHTS_SUM_TO_ONE = MIS == MIS_BALANCE || MIS == MIS_PAIRWISE;

layout(std430, binding = 0) writeonly buffer Reservoirs { uvec4 out_reservoirs[]; };
layout(std430, binding = 1) writeonly buffer Rays { uvec4 out_rays[]; };
layout(std430, binding = 2) writeonly buffer ShadowRays { uvec4 out_shadow_rays[]; };
layout(binding = UNIT_PASS_A) uniform usamplerBuffer in_reservoirs;
layout(binding = UNIT_PASS_B) uniform samplerBuffer ray_answers;

ivec2 band_pixel() { return ivec2(gl_GlobalInvocationID.xy) + ivec2(0, band_begin); }
bool is_outside_band(ivec2 pixel) { return pixel.x >= int(frame_size.x) || pixel.y >= band_end; }

// ---- Rays and answers

uint first_ray(ivec2 pixel) {
    return (pixel_index(pixel) - uint(band_begin) * frame_size.x) * rays_per_pixel;
}

void store_ray(ivec2 pixel, uint slot, RayRecord ray) {
    uvec4 row0, row1;
    pack_ray(ray, row0, row1);
    uint row = (first_ray(pixel) + slot) * RAY_ROWS;
    out_rays[row] = row0;
    out_rays[row + 1u] = row1;
}

// For pixels without anything to reuse: the tracer passes over these.
void store_no_rays(ivec2 pixel) {
    for (uint slot = 0u; slot < rays_per_pixel; ++slot) store_ray(pixel, slot, inactive_ray());
}

float load_answer(ivec2 pixel, uint slot) { return texelFetch(ray_answers, int(first_ray(pixel) + slot)).x; }

// ---- Results

// Stores what a step found and, after the last step, the ray that tests it.
void store_reservoir(ivec2 pixel, Receiver receiver, SampleReservoir r) {
    uvec4 row0, row1;
    pack_reservoir(r.state, pack_sample(r.chosen), row0, row1);
    uint row = pixel_index(pixel) * RESERVOIR_STRIDE;
    out_reservoirs[row] = row0;
    out_reservoirs[row + 1u] = row1;
    for (uint i = 0u; i < SAMPLE_ROWS; ++i)
        out_reservoirs[row + RESERVOIR_ROWS + i] = pack_sample_row(r.chosen, i);
#ifdef TARN_LAST_STEP
    RayRecord ray = inactive_ray();
    if (holds_sample(r)) ray = sample_ray(receiver, r.chosen, pixel);
    pack_ray(ray, row0, row1);
    row = pixel_index(pixel) * RAY_ROWS;
    out_shadow_rays[row] = row0;
    out_shadow_rays[row + 1u] = row1;
#endif
}

// A reservoir being merged: which sample leads, and what its technique knows of it.
struct Merge {
    SAMPLE chosen;
    LiveReservoir live;
    float visibility;      // of the leading sample
    float visibility_sum;  // of all, by weight
    float age;             // of the leading sample
};

Merge empty_merge() { return Merge(no_sample(), empty_live_reservoir(), 1.0f, 0.0f, 0.0f); }

// Offers the sample of `from`, whose target here is `target`, with resampling weight `weight`. True where it now leads.
bool offer_merged(inout Merge m, SampleReservoir from, float target, float weight, float u) {
    float before = m.live.weight_sum;
    uint offer = offer_candidate(m.live, target, weight, u);
    if (offer == OFFER_BAD) {
        count_event(COUNTER_BAD_WEIGHT);
        return false;
    }
    bool taken = offer == OFFER_TAKEN;
    if (taken) m.chosen = from.chosen;
    m.visibility = taken ? from.state.visibility : m.visibility;
    m.age = taken ? from.state.age : m.age;
    m.visibility_sum += from.state.visibility * (m.live.weight_sum - before);
    return taken;
}

// `normalization` divides the sum of weights: 1 for MIS weights that were applied on the way, else M or Z.
SampleReservoir finish_merge(Merge m, float confidence, float normalization) {
    float weight_sum = m.live.weight_sum;
#ifndef TARN_PLANT_DROP_NORMALIZATION
    m.live.weight_sum = ratio_or_zero(weight_sum, normalization);
#endif
    Reservoir r = finish_reservoir(m.live, confidence);
    if (has_overflown(m.live) || (weight_sum > 0.0f && normalization == 0.0f))
        count_event(COUNTER_BAD_RESERVOIR);
    r.age = m.age;
    r.visibility = m.visibility;
    if (TARN_FINAL_VISIBILITY == FINAL_VISIBILITY_AVERAGED)
        r.visibility = bounded_ratio(m.visibility_sum, weight_sum);
    if (MIS_VISIBILITY) r.visibility = 1.0f;
    if (r.contribution_weight == 0.0f) m.chosen = no_sample();
    return SampleReservoir(m.chosen, r);
}
