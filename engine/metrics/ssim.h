// SSIM: structural similarity, for golden images.
#pragma once

#include "core/image.h"

namespace tarn {

// Returns the mean structural similarity of two display-encoded images, 1 for equal ones (Z. Wang et al.,
// "Image Quality Assessment: From Error Visibility to Structural Similarity", 2004): on luma (Rec. 709
// weights of encoded values, clamped to [0, 1]), Gaussian window of 11 x 11 with deviation 1.5, K1 = 0.01, K2
// = 0.03; the border's pixels are repeated outwards. Pixels that are not finite in either image count as
// black and are left out of the mean. Throws Error where sizes differ or channels are not 3.
double compute_ssim(const Image& reference, const Image& image);

}  // namespace tarn
