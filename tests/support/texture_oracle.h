// Texture lookup once more, in double precision and 64-bit integers, as OpenGL and glTF define it.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "shared/math/texture_filter.h"

namespace tarn::test {

// The wrap modes as OpenGL 4.5 writes them (table 8.20).
inline int wrap_by_definition(std::int64_t coordinate, std::int64_t size, uint wrap) {
    const auto modulo = [](std::int64_t a, std::int64_t b) { return ((a % b) + b) % b; };
    if (wrap == WRAP_REPEAT) return int(modulo(coordinate, size));
    if (wrap == WRAP_CLAMP) return int(std::min(std::max(coordinate, std::int64_t(0)), size - 1));
    const std::int64_t folded = modulo(coordinate, 2 * size) - size;
    return int((size - 1) - (folded >= 0 ? folded : -(1 + folded)));
}

// The filtered value at uv of a texture with texel value(x, y).
template <class Texel>
double filter_by_definition(const glm::dvec2& uv, const ivec2& size, uint wrap_u, uint wrap_v,
                            const Texel& texel) {
    const double x = uv.x * size.x - 0.5, y = uv.y * size.y - 0.5;
    double sum = 0.0;
    for (int dy = 0; dy < 2; ++dy) {
        for (int dx = 0; dx < 2; ++dx) {
            const double cell_x = std::floor(x) + dx, cell_y = std::floor(y) + dy;
            const double weight = (1.0 - std::abs(x - cell_x)) * (1.0 - std::abs(y - cell_y));
            sum += weight * texel(wrap_by_definition(std::int64_t(cell_x), size.x, wrap_u),
                                  wrap_by_definition(std::int64_t(cell_y), size.y, wrap_v));
        }
    }
    return sum;
}

}  // namespace tarn::test
