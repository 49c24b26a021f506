// Reuse of path samples: passes/reuse with indirect light's shaders.
#pragma once

#include "passes/reuse/reuse.h"

namespace tarn {

// Refers to `frame`.
ReuseStage indirect_reuse(const FrameContext& frame);

// Whether this frame asks again, by a ray, whether kept samples are still lit by their lamps, and fresh ones
// were in the last frame. Where the weights trace visibility: whenever anything changed, so that nothing is
// stale. Else every `--indirect-validation` frames, if anything has changed since it last asked.
bool tests_lamps(const FrameContext& frame);

}  // namespace tarn
