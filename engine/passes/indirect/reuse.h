// Reuse of path samples: passes/reuse with indirect light's shaders.
#pragma once

#include "passes/reuse/reuse.h"

namespace tarn {

// Refers to `frame`.
ReuseStage indirect_reuse(const FrameContext& frame);

}  // namespace tarn
