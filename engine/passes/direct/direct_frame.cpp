#include "passes/direct/direct_frame.h"

#include "core/error.h"
#include "gl/handle.h"

namespace tarn {

RowBuffer make_pixel_rows(const std::string& name, int width_px, int height_px, std::size_t rows,
                          BufferUse use) {
    const std::size_t pixel_bytes = rows * sizeof(glm::uvec4);
    const std::size_t limit = std::size_t(get_gl_limit(GL_MAX_SHADER_STORAGE_BLOCK_SIZE)) / pixel_bytes;
    const std::size_t pixels = std::size_t(width_px) * std::size_t(height_px);
    if (pixels > limit) {
        throw Error("a picture of {} x {} has {} pixels, the driver's storage blocks hold {}", width_px,
                    height_px, pixels, limit);
    }
    return RowBuffer(name, pixels * pixel_bytes, use, GL_RGBA32UI);
}

}  // namespace tarn
