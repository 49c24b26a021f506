// Constants of antialias.
#pragma once

#include "shared/interface/constants/block.h"

SHARED_BEGIN

PASS_CONSTANTS(AntialiasConstants) {
    float steady_count;        // samples that the past counts as while things move
    float greatest_count;      // and when they have long been at rest
    uint has_previous;         // whether there is a last picture
    uint trusts_past;          // whether what it shows may be taken as it is: else all of it is clipped
    uint has_changes;          // whether lights changed, and where is known
    uint has_previous_motion;  // whether the last frame's surfaces know where they were before
};

SHARED_END
