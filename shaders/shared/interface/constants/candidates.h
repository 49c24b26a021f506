// Constants of direct/candidates.
#pragma once

#include "shared/interface/constants/block.h"

SHARED_BEGIN

PASS_CONSTANTS(CandidatesConstants) {
    vec4 target_weights;  // of the channels in the target (p-hat): luminance, or one channel; w = 0
    uint candidate_count;
    uint sample_index;  // of the frame's samples of each pixel
};

SHARED_END
