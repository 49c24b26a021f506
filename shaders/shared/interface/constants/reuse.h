// Constants of a step of reuse (lib/reuse/temporal.glsl, lib/reuse/spatial.glsl).
#pragma once

#include "shared/interface/constants/block.h"

SHARED_BEGIN

PASS_CONSTANTS(ReuseConstants) {
    // Of the channels in the target (p-hat): luminance, or one channel. w: 1 for the target of light that
    // arrives (indirect light alone), 0 for that of what is reflected.
    vec4 target_weights;
    int band_begin;  // the band of rows: its first and the one after its last
    int band_end;
    uint rays_per_pixel;
    // Over time.
    float confidence_cap;  // of the history, as a multiple of the fresh sample's
    float age_cap;         // frames after which a sample is dropped; 0: never
    uint permute;          // 1: neighbours of a pixel swap their histories
    uint
        carried_rays;  // first ray of a pixel that asks for the light that samples carry; INVALID_INDEX: none
    // Over space.
    float radius_px;
    uint iteration;
    uint mirror;  // 1: neighbours outside of the picture are mirrored into it
};

SHARED_END
