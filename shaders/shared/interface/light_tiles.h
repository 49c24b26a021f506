// Tiles of light samples that direct/light_tiles draws for direct/candidates.
#pragma once

#include "shared/dialect.h"

SHARED_BEGIN

CONSTANT uint LIGHT_TILE_COUNT = 128u;
CONSTANT uint LIGHT_TILE_SIZE = 1024u;  // samples a tile
// A sample: the four rows of its light, then (light, barycentrics, pdf by power).
CONSTANT uint LIGHT_TILE_ROWS = 5u;

SHARED_END
