// Constants of direct/boiling_filter.
#pragma once

#include "shared/interface/constants/block.h"

SHARED_BEGIN

PASS_CONSTANTS(BoilingFilterConstants) {
    float limit;  // multiple of the neighbourhood's mean weight
};

SHARED_END
