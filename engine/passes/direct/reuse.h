// Reuse of light samples: passes/reuse with direct light's shaders.
#pragma once

#include "passes/reuse/initial_visibility.h"
#include "passes/reuse/reuse.h"

namespace tarn {

// `answers`: of the fresh samples' rays.
Samples apply_direct_visibility(const FrameContext& frame, Samples fresh, const Answers& answers);

// Refers to `frame`.
ReuseStage direct_reuse(const FrameContext& frame);

}  // namespace tarn
