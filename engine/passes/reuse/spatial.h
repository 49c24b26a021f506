// Reuse over space: the samples of a pixel and of some of its neighbours.
#pragma once

#include "passes/reuse/reuse_step.h"

namespace tarn {

// Merges the samples of `input`; `iteration` counts from 0 and decides who the neighbours are.
Samples reuse_over_space(const FrameContext& frame, const ReuseShaders& shaders, const ReusePlan& plan,
                         const ReuseSettings& settings, const ReuseInput& input, int iteration);

}  // namespace tarn
