// Colours for error maps.
#pragma once

#include "core/image.h"

namespace tarn {

// Returns display-encoded RGB: black for 0 over violet, red and orange to pale yellow for 1, lightness rising
// evenly. Values are clamped to [0, 1]; NaN (left-out pixels) is shown in cyan, which no error has.
Image heat_map(const Image& error_map);

}  // namespace tarn
