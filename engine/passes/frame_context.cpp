#include "passes/frame_context.h"

#include "core/error.h"
#include "gl/handle.h"

namespace tarn {

bool FrameContext::has_row_groups() const {
    // Narrow pictures lie in few pages whatever the groups, and would leave much of the last group of each
    // row without work.
    constexpr int ROW_PX = 64;
    constexpr int MIN_WIDTH_PX = 4 * ROW_PX;
    const int covered_px = (size_px.x + ROW_PX - 1) / ROW_PX * ROW_PX;
    return recorder.quirks().groups_are_rows && size_px.x >= MIN_WIDTH_PX && covered_px * 8 <= size_px.x * 9;
}

Rows FrameContext::take_pixel_rows(const std::string& name, std::size_t rows, BufferUse use) const {
    const std::size_t pixel_bytes = rows * sizeof(glm::uvec4);
    const std::size_t limit = std::size_t(get_gl_limit(GL_MAX_SHADER_STORAGE_BLOCK_SIZE)) / pixel_bytes;
    if (pixel_count() > limit) {
        throw Error("a picture of {} x {} has {} pixels, the driver's storage blocks hold {}", size_px.x,
                    size_px.y, pixel_count(), limit);
    }
    return recorder.take_rows(name, pixel_count() * pixel_bytes, use);
}

}  // namespace tarn
