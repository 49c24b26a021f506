// The bytes of a mask's file, as engine/noise/mask_format.h lays them out.
#pragma once

#include <cstdint>
#include <vector>

#include "blue_noise/void_and_cluster.h"

namespace tarn::noise {

// Two coordinates for each texel. A rank becomes rank / (width * height), in units of 2^-16.
std::vector<unsigned char> encode_mask(const MaskSize& size, const Ranks& first, const Ranks& second);

// The mask that Tarn uses: makes both coordinates. The same seed gives the same bytes.
std::vector<unsigned char> make_mask_file(const MaskSize& size, std::uint32_t seed);

}  // namespace tarn::noise
