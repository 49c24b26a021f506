// Constants of direct/shade.
#pragma once

#include "shared/interface/constants/block.h"

SHARED_BEGIN

// Views of path samples; their order is that of DebugView.
CONSTANT uint PATH_VIEW_DIRECTION = 0u;  // from the receiver to the place
CONSTANT uint PATH_VIEW_DISTANCE = 1u;   // to the place, metres
CONSTANT uint PATH_VIEW_NORMAL = 2u;     // of the place
CONSTANT uint PATH_VIEW_RADIANCE = 3u;   // that the place sends
CONSTANT uint PATH_VIEW_WEIGHT = 4u;     // contribution weight
CONSTANT uint PATH_VIEW_AGE = 5u;        // frames

PASS_CONSTANTS(ShadeConstants) {
    // Of the channels in the target (p-hat): luminance, or one channel. w: 1 for the target of light that
    // arrives (indirect light alone), 0 for that of what is reflected.
    vec4 target_weights;
    float share;  // of this sample in the picture
    uint view;    // which quality of path samples is shown, DebugView
};

SHARED_END
