// Fills the tiles of light samples: each by power, independent of all others. One invocation a sample.
#include "lib/scene_buffers.glsl"
#include "lib/frame.glsl"
#include "shared/interface/light_tiles.h"
#include "lib/pixel_group.glsl"

layout(std430, binding = 0) writeonly buffer Tiles { uvec4 out_tiles[]; };

void main() {
    uint entry = gl_GlobalInvocationID.y * LIGHT_TILE_SIZE + gl_GlobalInvocationID.x;
    if (gl_GlobalInvocationID.x >= LIGHT_TILE_SIZE || gl_GlobalInvocationID.y >= LIGHT_TILE_COUNT) return;
    RandomKey key;
    key.pixel = entry;
    key.frame = frame_size.z;
    key.seed = frame_size.w;
    LightCandidate c = draw_light_by_power(random_bits4(key, DIMENSION_TILE + 1u));
    Light light = load_light(c.drawn.light);
    LightTileSample s =
        make_light_tile_sample(light, c.drawn, c.pdf, load_triangle_radiance(light, c.drawn.uv));
    uvec4 row0, row1, row2, row3;
    pack_light_tile_sample(s, row0, row1, row2, row3);
    uint row = entry * LIGHT_TILE_ROWS;
    out_tiles[row] = row0;
    out_tiles[row + 1u] = row1;
    out_tiles[row + 2u] = row2;
    out_tiles[row + 3u] = row3;
}
