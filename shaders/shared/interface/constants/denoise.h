// Constants of denoise/accumulate and denoise/filter.
#pragma once

#include "shared/interface/constants/block.h"

SHARED_BEGIN

PASS_CONSTANTS(DenoiseConstants) {
    float history_frames;    // the history counts as so many frames at most
    float luminance_factor;  // how many variances two luminances may differ by
    int step_px;             // from one tap of the filter to the next
    uint is_diagonal;        // the cross of this step stands on its corners
    uint has_previous;       // whether there is a last frame
    uint has_changes;        // whether changes of the light are known (TARN_ADAPTIVE)
};

SHARED_END
