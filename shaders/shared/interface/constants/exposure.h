// Constants of exposure.
#pragma once

#include "shared/interface/constants/block.h"

SHARED_BEGIN

PASS_CONSTANTS(ExposureConstants) {
    float step_share;   // of the way from the last frame's exposure to this picture's, in stops
    float fixed_ev;     // taken instead where is_fixed is 1
    float fixed_scale;  // 2^fixed_ev
    uint is_fixed;
    uint tone;          // TONE_*
    uint has_previous;  // whether there is a last frame
};

SHARED_END
