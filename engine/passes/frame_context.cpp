#include "passes/frame_context.h"

#include "core/error.h"
#include "gl/handle.h"

namespace tarn {

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
