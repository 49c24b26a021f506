// Constants of indirect/rays, indirect/vertices and indirect/samples.
#pragma once

#include "shared/interface/constants/block.h"

SHARED_BEGIN

PASS_CONSTANTS(IndirectConstants) {
    vec4 target_weights;     // of the channels in the target (p-hat); w = 0
    uint bounce;             // 0: the first surface that the path meets
    uint candidate_count;    // light candidates of next-event estimation
    float cache_cell_share;  // as in constants/cache.h
};

SHARED_END
