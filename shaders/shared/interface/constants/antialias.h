// Constants of antialias.
#pragma once

#include "shared/interface/constants/block.h"

SHARED_BEGIN

PASS_CONSTANTS(AntialiasConstants) {
    float steady_count;    // samples that the past counts as while things move
    float greatest_count;  // and when they have long been at rest
    uint has_previous;     // whether there is a last picture
};

SHARED_END
