// Glare over whole images, as passes/glare has it on the device.
#pragma once

#include "core/image.h"

namespace tarn {

// Spreads what is brighter than white (1) in `exposed`, linear RGB without negative values or NaN, as
// shared/math/glare.h says. The picture's sum stays.
void add_glare_to(Image& exposed, float strength);

}  // namespace tarn
