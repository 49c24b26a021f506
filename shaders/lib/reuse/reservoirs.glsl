// Reservoirs and their samples, in and out of memory.
//
// lib/reuse does not know what is resampled. Whoever includes it has said before (lib/direct/light_samples.glsl does so
// for light samples):
//
//   SAMPLE                                     the type of a sample
//   SAMPLE no_sample(); bool is_sample(SAMPLE)
//   uvec3 pack_sample(SAMPLE); SAMPLE unpack_sample(uvec3)
//   float sample_target(Receiver, SAMPLE)      p-hat without visibility
//   BrdfValue reflect_sample(Receiver, SAMPLE) what it sends to the viewer, before W
//   RayRecord sample_ray(Receiver, SAMPLE, ivec2 pixel)
//   float shift_jacobian(Receiver from, Receiver to, SAMPLE)   |dT/dx| between the domains of two receivers
//   TEMPORAL_DIMENSION, SPATIAL_DIMENSION      random dimensions (shared/math/random.h)
//
// and, for reuse over time: move_to_previous, move_to_present, move_jacobian, previous_sample_target,
// previous_sample_ray.
#include "shared/math/reservoir.h"

struct SampleReservoir {
    SAMPLE chosen;
    Reservoir state;
};

SampleReservoir empty_sample_reservoir() { return SampleReservoir(no_sample(), empty_reservoir()); }

// A sample without weight is none, whatever its words say.
bool holds_sample(SampleReservoir r) { return r.state.contribution_weight > 0.0f; }

SampleReservoir load_reservoir(usamplerBuffer rows, ivec2 pixel) {
    int row = int(pixel_index(pixel) * RESERVOIR_ROWS);
    uvec4 head = texelFetch(rows, row);
    return SampleReservoir(unpack_sample(head.xyz), unpack_reservoir(head, texelFetch(rows, row + 1)));
}

float load_confidence(usamplerBuffer rows, ivec2 pixel) {
    return uintBitsToFloat(texelFetch(rows, int(pixel_index(pixel) * RESERVOIR_ROWS) + 1).x);
}
