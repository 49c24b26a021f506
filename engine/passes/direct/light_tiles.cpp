#include "passes/direct/light_tiles.h"

#include "shared/interface/light_tiles.h"

namespace tarn {

LightTilesPass::LightTilesPass(ProgramLibrary& programs)
    : programs_(programs),
      tiles_("direct/light_tiles",
             std::size_t(LIGHT_TILE_COUNT * LIGHT_TILE_SIZE * LIGHT_TILE_ROWS) * sizeof(glm::uvec4),
             BufferUse::DEVICE, GL_RGBA32UI) {}

const RowBuffer& LightTilesPass::record(const DirectFrame& direct) {
    direct.frame.pass("direct/light_tiles")
        .write(0, tiles_)
        .dispatch(programs_.compute("direct/light_tiles", direct.defines), int(LIGHT_TILE_SIZE),
                  int(LIGHT_TILE_COUNT));
    return tiles_;
}

}  // namespace tarn
