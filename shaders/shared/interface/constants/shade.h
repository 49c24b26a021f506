// Constants of direct/shade.
#pragma once

#include "shared/interface/constants/block.h"

SHARED_BEGIN

PASS_CONSTANTS(ShadeConstants) {
    vec4 target_weights;  // of the channels in the target (p-hat): luminance, or one channel; w = 0
    float share;          // of this sample in the picture
};

SHARED_END
