// Makes blue noise masks by void and cluster. The essay stands in void_and_cluster.cpp.
#pragma once

#include <cstdint>
#include <vector>

namespace tarn::noise {

// Of a mask, in texels. Width and height are powers of two, at least 32.
struct MaskSize {
    int width = 64;
    int height = 64;
    int slices = 32;
};

// One rank for each texel, in x, then y, then slices: 0 to width * height - 1, each once a slice.
using Ranks = std::vector<std::uint16_t>;

// Energy between two texels of a slice, and between a pixel at two times: exp(-d^2 / (2 s^2)) of their
// toroidal distance d in pixels or slices.
inline constexpr double ENERGY_SIGMA_PX = 1.9;
inline constexpr double ENERGY_SIGMA_SLICES = 1.9;
// Pixels farther apart than this, in x or y, do not see each other: their energy would be below 2e-4.
inline constexpr int ENERGY_RADIUS_PX = 8;

// Of that many successive ranks of the second coordinate, each belongs to another of as many equal ranges of
// the first.
inline constexpr int STRATA = 16;

// A mask for one coordinate: each slice is blue over x and y, each pixel over time, with wrap-around in all
// three. The same size and seed give the same ranks.
Ranks make_blue_noise(const MaskSize& size, std::uint32_t seed);

// A second coordinate for `first`, a mask of the same size: blue by itself and, together with the first, as a
// point of the unit square.
Ranks make_second_coordinate(const MaskSize& size, const Ranks& first, std::uint32_t seed);

}  // namespace tarn::noise
