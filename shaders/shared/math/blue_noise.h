// Spatiotemporal blue noise: how two numbers for (pixel, frame, seed, dimension) are read from the mask that
// tools/blue_noise makes.
//
// The mask repeats in x, y and time, and each seed and dimension reads it from a place of its own. Since each
// slice holds each rank once, the first number is then uniform over seeds, with its spectrum as it is. The
// second is also turned round the unit circle by a random angle (Cranley and Patterson 1976), so that both
// together are uniform over the square: estimators stay unbiased. Where turned values wrap, some low
// frequencies come back. An angle of the integrand has no such seam: take the second number for it, as the
// warps do.
//
// Place and angle are the same for all pixels and for the frames of one period, so that the noise stays blue
// over both. Within a picture pixels therefore depend on each other, on purpose; those BLUE_NOISE_SIZE apart
// share their numbers.
#pragma once

#include "shared/math/random.h"

SHARED_BEGIN

CONSTANT uint BLUE_NOISE_SIZE = 64u;       // width and height of a slice of the mask, in pixels
CONSTANT uint BLUE_NOISE_SLICES = 32u;     // frames until the mask repeats
CONSTANT uint BLUE_NOISE_RANK_BITS = 12u;  // log2 of the texels of a slice, which have as many ranks
CONSTANT uint BLUE_NOISE_TEXEL_COUNT = BLUE_NOISE_SIZE * BLUE_NOISE_SIZE * BLUE_NOISE_SLICES;

// What a seed and a dimension do to the mask.
struct BlueNoiseShift {
    uint place;     // added to the texel's index, coordinate by coordinate
    uint jitter;    // added to the first number, in 2^-32: less than the step between ranks
    uint rotation;  // added to the second number, in 2^-32 turns
};

// The shift of `frame`'s period. Each period has its own: otherwise a mean over more frames than one period
// would see the same numbers again and would not converge.
FN BlueNoiseShift blue_noise_shift(uint frame, uint seed, uint dimension) {
    // No pixel has this index: these bits are of no other random number.
    uvec4 bits = hash_pcg4d(uvec4(INVALID_INDEX, frame / BLUE_NOISE_SLICES, seed, dimension));
    BlueNoiseShift shift;
    shift.place = bits.x >> 15u;
    shift.jitter = bits.y >> BLUE_NOISE_RANK_BITS;
    shift.rotation = bits.z;
    return shift;
}

// Index of the texel of the mask that `pixel` reads: x first, then y, then the slice.
FN uint blue_noise_texel(BlueNoiseShift shift, uvec2 pixel, uint frame) {
    uint x = (pixel.x + shift.place) % BLUE_NOISE_SIZE;
    uint y = (pixel.y + shift.place / BLUE_NOISE_SIZE) % BLUE_NOISE_SIZE;
    uint slice = (frame + shift.place / (BLUE_NOISE_SIZE * BLUE_NOISE_SIZE)) % BLUE_NOISE_SLICES;
    return x + BLUE_NOISE_SIZE * (y + BLUE_NOISE_SIZE * slice);
}

// The two numbers in [0, 1), multiples of 2^-24. A texel holds the first coordinate in its lower 16 bits and
// the second in the upper ones, each with zeros below its rank. The second sum wraps at a full turn.
FN vec2 shift_blue_noise(BlueNoiseShift shift, uint texel) {
    return vec2(float_from_bits((texel << 16u) + shift.jitter),
                float_from_bits((texel & 0xffff0000u) + shift.rotation));
}

SHARED_END
