// Sample impoverishment: how many pixels show the light of the very same sample as a neighbour. Their errors
// are alike, which the eye sees as blotches and MSE does not.
#pragma once

#include "core/image.h"

namespace tarn {

// The share of pixels whose value equals, bit for bit, that of at least one of the eight pixels around; of a
// picture that shows which sample each pixel chose. Black pixels chose none and are no part of it; 0 where
// all are black.
double find_shared_sample_share(const Image& samples);

}  // namespace tarn
