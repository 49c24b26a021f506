#include "passes/direct/light_tiles.h"

#include "shared/interface/light_tiles.h"

namespace tarn {

Rows draw_light_tiles(const FrameContext& frame) {
    const std::size_t rows = LIGHT_TILE_COUNT * LIGHT_TILE_SIZE * LIGHT_TILE_ROWS;
    const Rows tiles =
        frame.recorder.take_rows("direct/light_tiles", rows * sizeof(glm::uvec4), BufferUse::DEVICE);
    frame.pass("direct/light_tiles")
        .write(0, tiles)
        .dispatch(frame.compute(LightTilesVariant{}), {LIGHT_TILE_SIZE, LIGHT_TILE_COUNT});
    return tiles;
}

}  // namespace tarn
