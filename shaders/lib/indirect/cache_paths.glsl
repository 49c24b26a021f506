// Which pixels' paths add to the radiance cache, and where in memory. After the constants of the cache's passes,
// lib/frame.glsl and lib/indirect/world_cache.glsl.

bool is_outside_of_cache_paths(ivec2 at) { return at.x >= int(cache_width) || at.y >= int(cache_height); }

uint cache_path_index(ivec2 at) { return uint(at.y) * cache_width + uint(at.x); }

// Another one of its block in each frame; at the edge it may lie outside.
ivec2 cache_path_pixel(ivec2 at) {
    return at * int(cache_step) + ivec2(int(cache_offset_x), int(cache_offset_y));
}

// Words of a place in the sums.
const uint CACHE_COUNT = 3u;   // 0-2: low words of red, green, blue
const uint CACHE_HIGH = 4u;    // 4-6: their high words
const uint CACHE_ASKING = 7u;  // checksum of the key that asks for this place

uint sum_word(uint bucket, uint place) { return (bucket * CACHE_PLACES + place) * CACHE_SUM_ROWS * 4u; }
