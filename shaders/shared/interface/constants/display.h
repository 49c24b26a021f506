// Constants of display.
#pragma once

#include "shared/interface/constants/block.h"

SHARED_BEGIN

PASS_CONSTANTS(DisplayConstants) {
    float exposure_scale;  // radiance times this is shown
};

SHARED_END
