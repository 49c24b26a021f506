// Constants of indirect/cache_rays, cache_vertices, cache_update and cache_resolve.
#pragma once

#include "shared/interface/constants/block.h"

SHARED_BEGIN

PASS_CONSTANTS(CacheConstants) {
    vec4 target_weights;   // of the channels in the target of light candidates; w = 0
    uint candidate_count;  // light candidates of next-event estimation
    uint cache_width;      // of the picture of paths that add to the cache, pixels
    uint cache_height;
    uint cache_step;      // one pixel in step x step has such a path
    uint cache_offset_x;  // which one
    uint cache_offset_y;
    float cache_unit;        // irradiance that a sum counts as 1, W/m^2
    float cache_limit;       // of one sample, in that unit: so many cannot overflow a sum
    float cache_cell_share;  // edge of a fine cell over its distance from the camera, at most
};

SHARED_END
