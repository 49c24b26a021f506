// Light that is brighter than white, spread as it is in the eye.
#pragma once

#include "passes/exposure.h"

namespace tarn {

// The sum of the pyramid's pictures at half of `radiance`'s size (RGBA32F), exposed; shared/math/glare.h says
// what it is. For show_frame, which adds it.
Picture spread_glare(const FrameContext& frame, const Picture& radiance, const Exposure& exposure);

}  // namespace tarn
