// Constants of display.
#pragma once

#include "shared/interface/constants/block.h"

SHARED_BEGIN

PASS_CONSTANTS(DisplayConstants) {
    uint width_px;  // of the picture that is shown
    uint height_px;
    uint tone;             // TONE_*
    float glare_strength;  // with TARN_GLARE
};

SHARED_END
