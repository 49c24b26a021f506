// Constants of average.
#pragma once

#include "shared/interface/constants/block.h"

SHARED_BEGIN

PASS_CONSTANTS(AverageConstants) {
    uint frame_count;  // that the mean has, this one not among them
    uint has_before;   // whether there is a picture before the mean
};

SHARED_END
