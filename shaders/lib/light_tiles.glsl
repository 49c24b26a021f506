// Tiles of light samples drawn in advance by power (Wyman and Panteleev 2021): candidates of neighbouring pixels then
// come from a few rows that stay in the cache, however many lights there are. After lib/scene_buffers.glsl.
#include "shared/interface/light_tiles.h"

layout(binding = UNIT_PASS_A) uniform usamplerBuffer light_tiles;

// All pixels of a block of 8 x 8 share a tile.
uint tile_of(ivec2 pixel) {
    RandomKey key;
    key.pixel = uint(pixel.y / 8) * ((frame_size.x + 7u) / 8u) + uint(pixel.x / 8);
    key.frame = frame_size.z;
    key.seed = frame_size.w;
    return random_bits4(key, DIMENSION_TILE).x % LIGHT_TILE_COUNT;
}

// The samples of a pixel follow one another in its tile, from a place that `bits` choose: each is drawn independently
// of the others, so that any of them will do, and those that follow one another are soon in the cache.
struct LightTileWindow {
    uint tile_begin;
    uint first;
};

LightTileWindow find_tile_window(ivec2 pixel, uint bits) {
    return LightTileWindow(tile_of(pixel) * LIGHT_TILE_SIZE, uniform_index(bits, LIGHT_TILE_SIZE));
}

// Sample `i` of the window, its density by power, and what it sends to `point`.
LightCandidate load_tile_candidate(LightTileWindow window, uint i, vec3 point, out IncidentLight incident) {
    uint entry = window.tile_begin + (window.first + i) % LIGHT_TILE_SIZE;
    int row = int(entry * LIGHT_TILE_ROWS);
    LightTileSample s =
        unpack_light_tile_sample(texelFetch(light_tiles, row), texelFetch(light_tiles, row + 1),
                                 texelFetch(light_tiles, row + 2), texelFetch(light_tiles, row + 3));
    bool triangle = !SCENE_HAS_PUNCTUAL_LIGHTS || (SCENE_HAS_TRIANGLE_LIGHTS && s.is_triangle);
    incident = incident_from_tile_sample(s, triangle, point);
    LightCandidate c;
    c.drawn = s.drawn;
    c.pdf = s.pdf;
    return c;
}
