// Texture lookup by hand: wrap modes and bilinear weights at mip 0, the same arithmetic in shaders and on the
// CPU.
//
// Core GL cannot index samplers per pixel and llvmpipe has no bindless textures, so all texels live in one
// buffer.
#pragma once

#include "shared/dialect.h"

SHARED_BEGIN

CONSTANT uint WRAP_REPEAT = 0u;
CONSTANT uint WRAP_CLAMP = 1u;
CONSTANT uint WRAP_MIRROR = 2u;

// The four texels around a point and their weights; indices count from the texture's first texel.
struct TexelFootprint {
    uvec4 indices;
    vec4 weights;
};

// Texel coordinate -> [0, size) as the wrap mode says.
FN int wrap_texel(int coordinate, int size, uint wrap) {
    if (wrap == WRAP_CLAMP) return clamp(coordinate, 0, size - 1);
    int period = wrap == WRAP_MIRROR ? 2 * size : size;
    int folded = coordinate - period * int(floor(float(coordinate) / float(period)));
    // The float quotient may round to the neighbouring period.
    if (folded < 0) folded += period;
    if (folded >= period) folded -= period;
    return folded < size ? folded : period - 1 - folded;
}

// uv: (0,0) is the upper left corner of the upper left texel. Values far outside float's exact integers are
// folded first, so that a wild coordinate gives some texel instead of undefined behaviour.
FN TexelFootprint texel_footprint(vec2 uv, ivec2 size, uint wrap_u, uint wrap_v, bool nearest) {
    float x = uv.x * float(size.x);
    float y = uv.y * float(size.y);
    // Before the clamp, whose answer to NaN differs from one driver to the next.
    x = is_finite(x) ? clamp(x, -8388608.0f, 8388608.0f) : 0.0f;
    y = is_finite(y) ? clamp(y, -8388608.0f, 8388608.0f) : 0.0f;
    if (!nearest) {
        x -= 0.5f;
        y -= 0.5f;
    }
    float cell_x = floor(x);
    float cell_y = floor(y);
    float fraction_x = nearest ? 0.0f : x - cell_x;
    float fraction_y = nearest ? 0.0f : y - cell_y;
    int x0 = wrap_texel(int(cell_x), size.x, wrap_u);
    int x1 = wrap_texel(int(cell_x) + 1, size.x, wrap_u);
    int y0 = wrap_texel(int(cell_y), size.y, wrap_v);
    int y1 = wrap_texel(int(cell_y) + 1, size.y, wrap_v);
    TexelFootprint footprint;
    footprint.indices =
        uvec4(uint(y0 * size.x + x0), uint(y0 * size.x + x1), uint(y1 * size.x + x0), uint(y1 * size.x + x1));
    footprint.weights = vec4((1.0f - fraction_x) * (1.0f - fraction_y), fraction_x * (1.0f - fraction_y),
                             (1.0f - fraction_x) * fraction_y, fraction_x * fraction_y);
    return footprint;
}

SHARED_END
