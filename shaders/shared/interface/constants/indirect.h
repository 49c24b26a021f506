// Constants of indirect/rays, indirect/vertices and indirect/samples.
#pragma once

#include "shared/interface/constants/block.h"

SHARED_BEGIN

PASS_CONSTANTS(IndirectConstants) {
    // Of the channels in the target (p-hat): luminance, or one channel. w: 1 for the target of light that
    // arrives (indirect light alone), 0 for that of what is reflected.
    vec4 target_weights;
    uint bounce;             // 0: the first surface that the path meets
    uint candidate_count;    // light candidates of next-event estimation
    float cache_cell_share;  // as in constants/cache.h
    float ray_share;         // of the surface's BRDF rays, those that are followed
};

SHARED_END
