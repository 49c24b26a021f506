// Reservoirs and their samples, in and out of memory.
//
// lib/reuse does not know what is resampled. Whoever includes it has said before (lib/direct/light_samples.glsl does so
// for light samples):
//
//   SAMPLE                                     the type of a sample
//   SAMPLE_ROWS                                rows that it needs behind a reservoir's own
//   SAMPLE no_sample(); bool is_sample(SAMPLE)
//   uvec3 pack_sample(SAMPLE)                  its words in the reservoir's head
//   uvec4 pack_sample_row(SAMPLE, uint index)  its rows
//   SAMPLE load_sample(usamplerBuffer, uvec3 head, int row)    out of these; `row`: its first one
//   float sample_target(Receiver, SAMPLE)      p-hat without visibility
//   BrdfValue reflect_sample(Receiver, SAMPLE) what it sends to the viewer, before W
//   RayRecord sample_ray(Receiver, SAMPLE, ivec2 pixel)
//   bool can_share(float alpha, float alpha)   whether receivers of these GGX widths may share samples at all
//   float shift_jacobian(Receiver from, Receiver to, SAMPLE)   |dT/dx| between the domains of two receivers
//   TEMPORAL_DIMENSION, SPATIAL_DIMENSION      random dimensions (shared/math/random.h)
//
// and, for reuse over time: move_to_previous, move_to_present, temporal_jacobian, previous_sample_target,
// previous_sample_ray; where samples carry light from further places (TARN_CARRIED_LIGHT) also can_ask_for_carried,
// carried_ray, previous_carried_ray.
#include "shared/math/reservoir.h"

const uint RESERVOIR_STRIDE = RESERVOIR_ROWS + SAMPLE_ROWS;

struct SampleReservoir {
    SAMPLE chosen;
    Reservoir state;
};

SampleReservoir empty_sample_reservoir() { return SampleReservoir(no_sample(), empty_reservoir()); }

// A sample without weight is none, whatever its words say.
bool holds_sample(SampleReservoir r) { return r.state.contribution_weight > 0.0f; }

SampleReservoir load_reservoir(usamplerBuffer rows, ivec2 pixel) {
    int row = int(pixel_index(pixel) * RESERVOIR_STRIDE);
    uvec4 head = texelFetch(rows, row);
    return SampleReservoir(load_sample(rows, head.xyz, row + int(RESERVOIR_ROWS)),
                           unpack_reservoir(head, texelFetch(rows, row + 1)));
}

float load_confidence(usamplerBuffer rows, ivec2 pixel) {
    return uintBitsToFloat(texelFetch(rows, int(pixel_index(pixel) * RESERVOIR_STRIDE) + 1).x);
}
