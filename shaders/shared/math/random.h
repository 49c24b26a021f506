// Counter-based random numbers: a pure function of (pixel, frame, seed, dimension), the same bits on both
// sides.
#pragma once

#include "shared/dialect.h"

SHARED_BEGIN

// What a random number depends on besides its dimension.
struct RandomKey {
    uint pixel;  // index of the pixel, row-major
    uint frame;  // frame, or sample index in the reference
    uint seed;
};

// PCG4D: four 32-bit words to four (Jarzynski and Olano, "Hash Functions for GPU Rendering", JCGT 9(3),
// 2020).
FN uvec4 hash_pcg4d(uvec4 v) {
    v = v * 1664525u + uvec4(1013904223u);
    v.x += v.y * v.w;
    v.y += v.z * v.x;
    v.z += v.x * v.y;
    v.w += v.y * v.z;
    v.x = v.x ^ (v.x >> 16u);
    v.y = v.y ^ (v.y >> 16u);
    v.z = v.z ^ (v.z >> 16u);
    v.w = v.w ^ (v.w >> 16u);
    v.x += v.y * v.w;
    v.y += v.z * v.x;
    v.z += v.x * v.y;
    v.w += v.y * v.z;
    return v;
}

// 24 random bits as a float in [0, 1): 1 itself never occurs.
FN float float_from_bits(uint bits) {
    return float(bits >> 8u) * (1.0f / 16777216.0f);
}

// Four independent words of 32 random bits.
FN uvec4 random_bits4(RandomKey key, uint dimension) {
    return hash_pcg4d(uvec4(key.pixel, key.frame, key.seed, dimension));
}

// Four independent numbers in [0, 1).
FN vec4 random4(RandomKey key, uint dimension) {
    uvec4 bits = random_bits4(key, dimension);
    return vec4(float_from_bits(bits.x), float_from_bits(bits.y), float_from_bits(bits.z),
                float_from_bits(bits.w));
}

// The number that decides whether a surface of partial coverage (alpha BLEND) is there for this ray. `ray`
// tells the rays of a pixel apart; the raster and the camera ray both use RAY_CAMERA and so agree on every
// layer.
FN float random_coverage(RandomKey key, uint ray, uint instance, uint primitive) {
    uvec4 bits = hash_pcg4d(uvec4(key.pixel, key.frame * 64u + ray, key.seed, 0x9e3779b9u));
    bits = hash_pcg4d(uvec4(bits.x, bits.y, instance, primitive));
    return float_from_bits(bits.x);
}

// Dimensions: each use has a range of its own, so that no two decisions share a number.
CONSTANT uint DIMENSION_SELECT = 0u;       // direct light: how many candidates go to the sky
CONSTANT uint DIMENSION_CANDIDATE = 16u;   // + candidate index, below 1024
CONSTANT uint DIMENSION_TEMPORAL = 1088u;  // reuse over time: the choice; once a frame: the permutation
CONSTANT uint DIMENSION_SPATIAL = 1152u;   // + 16 * iteration + neighbour: its place and whether it replaces
CONSTANT uint DIMENSION_TILE = 1280u;      // which light tile a group of pixels draws from
CONSTANT uint DIMENSION_BRDF = 1344u;      // + index of the candidate drawn from the BRDF
CONSTANT uint DIMENSION_CHOICE = 2048u;    // + candidate index: whether it replaces the one before
CONSTANT uint DIMENSION_PIXEL = 4096u;     // reference: position within the pixel
CONSTANT uint DIMENSION_BOUNCE = 8192u;    // reference: + 8 * bounce
CONSTANT uint DIMENSION_INDIRECT_TEMPORAL = 12288u;  // indirect light: as above
CONSTANT uint DIMENSION_INDIRECT_SPATIAL = 12352u;
CONSTANT uint DIMENSION_INDIRECT = 16384u;  // + DIMENSIONS_PER_BOUNCE * bounce
CONSTANT uint DIMENSIONS_PER_BOUNCE = 512u;
CONSTANT uint DIMENSION_CACHE = 28672u;        // paths that add to the radiance cache; below 29696
CONSTANT uint DIMENSIONS_PER_SAMPLE = 65536u;  // direct light: further samples of a pixel begin here
CONSTANT uint RAY_CAMERA = 0u;
CONSTANT uint RAY_SHADOW = 1u;
CONSTANT uint RAY_BOUNCE = 2u;  // reference: + bounce

SHARED_END
