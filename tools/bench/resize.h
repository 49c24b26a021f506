// Images at other sizes.
#pragma once

#include "core/image.h"

namespace tarn {

// `image` at another size, by bilinear interpolation between pixel centres; what lies beyond the outermost
// centres takes their value. For enlarging: a smaller picture would skip pixels.
Image resize_bilinear(const Image& image, int width_px, int height_px);

}  // namespace tarn
