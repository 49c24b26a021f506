#include "passes/antialias/jitter.h"

#include "core/error.h"

namespace tarn {

glm::vec2 find_jitter(std::uint32_t frame, int count) {
    TARN_ASSERT(count > 0 && (count & (count - 1)) == 0, "{} places in a pixel are no power of two", count);
    if (count == 1) return glm::vec2(0.0f);
    const std::uint32_t index = frame & (std::uint32_t(count) - 1u);
    // Both as fractions of 2^32: the bits mirrored, and the columns of Pascal's triangle modulo 2.
    std::uint32_t x = 0, y = 0;
    std::uint32_t column_x = 1u << 31, column_y = 1u << 31;
    for (std::uint32_t bits = index; bits != 0; bits >>= 1) {
        if ((bits & 1u) != 0u) {
            x ^= column_x;
            y ^= column_y;
        }
        column_x >>= 1;
        column_y ^= column_y >> 1;
    }
    constexpr double UNIT = 1.0 / 4294967296.0;
    const double middle = 0.5 - 0.5 / count;  // the mean of both
    return glm::vec2(float(x * UNIT - middle), float(y * UNIT - middle));
}

}  // namespace tarn
