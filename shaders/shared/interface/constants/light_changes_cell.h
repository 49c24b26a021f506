// Cells in which changes of the light are known.
#pragma once

#include "shared/dialect.h"

SHARED_BEGIN

// Width and height in pixels. One pixel of each compares its samples.
CONSTANT int CHANGE_CELL = 4;

SHARED_END
