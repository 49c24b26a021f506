// Constants of denoise/light_samples and denoise/light_changes.
#pragma once

#include "shared/interface/constants/block.h"
#include "shared/interface/constants/light_changes_cell.h"

SHARED_BEGIN

PASS_CONSTANTS(LightChangeConstants) {
    uint cells_x;  // cells of CHANGE_CELL x CHANGE_CELL pixels, along each axis
    uint cells_y;
    uint traces;  // whether the samples' visibility in both frames was traced
};

// Rays a cell: to the last frame's sample and to this frame's, each in this frame and in the last one.
CONSTANT uint CHANGE_RAYS = 4u;

SHARED_END
