// The radiance cache in world space: how large it is and where its rows are. What it does:
// shaders/lib/indirect/world_cache.glsl.
#pragma once

#include "shared/dialect.h"

SHARED_BEGIN

// Cells live in buckets. A key belongs to one bucket, and may stand in any place there.
CONSTANT uint CACHE_BUCKETS = 8192u;  // a power of two
CONSTANT uint CACHE_PLACES = 8u;      // in each

// Rows of a bucket of cells: the checksums of its places, then a row for each of them.
CONSTANT uint CACHE_KEY_ROWS = 2u;
CONSTANT uint CACHE_BUCKET_ROWS = 10u;  // CACHE_KEY_ROWS + CACHE_PLACES

// Rows of a place that one frame adds to: low words of three sums and how many were added, high words and the
// checksum of a key that asks for a place.
CONSTANT uint CACHE_SUM_ROWS = 2u;

// Rows that hold what a path brings for its cell: light that is certain, light that waits for its shadow ray.
CONSTANT uint CACHE_SAMPLE_ROWS = 2u;

// Buckets as a picture, of which each pixel is one.
CONSTANT uint CACHE_BUCKETS_WIDE = 128u;

SHARED_END
