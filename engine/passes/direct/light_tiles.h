// Tiles of light samples drawn in advance; see shaders/lib/light_tiles.glsl.
#pragma once

#include "passes/direct/direct_frame.h"

namespace tarn {

class LightTilesPass {
  public:
    explicit LightTilesPass(ProgramLibrary& programs);

    const RowBuffer& record(const DirectFrame& direct);

  private:
    ProgramLibrary& programs_;
    RowBuffer tiles_;
};

}  // namespace tarn
