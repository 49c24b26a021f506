// Constants of direct/initial_visibility.
#pragma once

#include "shared/interface/constants/block.h"

SHARED_BEGIN

PASS_CONSTANTS(InitialVisibilityConstants) {
    uint discard_occluded;  // 1: a sample that is not seen is dropped
};

SHARED_END
