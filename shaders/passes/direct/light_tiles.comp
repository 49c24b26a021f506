// Fills the tiles of light samples: each by power, independent of all others. One invocation a sample.
#include "lib/scene_buffers.glsl"
#include "lib/frame.glsl"
#include "shared/interface/light_tiles.h"

layout(local_size_x = 8, local_size_y = 8) in;

layout(std430, binding = 0) writeonly buffer Tiles { uvec4 out_tiles[]; };

void main() {
    uint entry = gl_GlobalInvocationID.y * LIGHT_TILE_SIZE + gl_GlobalInvocationID.x;
    if (gl_GlobalInvocationID.x >= LIGHT_TILE_SIZE || gl_GlobalInvocationID.y >= LIGHT_TILE_COUNT) return;
    RandomKey key;
    key.pixel = entry;
    key.frame = frame_size.z;
    key.seed = frame_size.w;
    LightCandidate c = draw_light_by_power(random_bits4(key, DIMENSION_TILE + 1u));
    uint row = entry * LIGHT_TILE_ROWS;
    for (uint i = 0u; i < LIGHT_ROWS; ++i)
        out_tiles[row + i] = fetch_light_row(c.drawn.light * LIGHT_ROWS + i);
    out_tiles[row + LIGHT_ROWS] = uvec4(c.drawn.light, floatBitsToUint(c.drawn.uv.x),
                                        floatBitsToUint(c.drawn.uv.y), floatBitsToUint(c.pdf));
}
