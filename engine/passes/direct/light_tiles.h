// Tiles of light samples drawn in advance; see shaders/lib/light_tiles.glsl.
#pragma once

#include "passes/frame_context.h"

namespace tarn {

Rows draw_light_tiles(const FrameContext& frame);

}  // namespace tarn
