// Reuse over time: the fresh sample of a pixel and what the same surface kept in the last frame.
#pragma once

#include "passes/reuse/reuse_step.h"

namespace tarn {

// Merges the samples of `input` with the last frame's. Without a previous frame there is nothing to merge: do
// not call it.
Samples reuse_over_time(const FrameContext& frame, const ReuseShaders& shaders, const ReusePlan& plan,
                        const ReuseSettings& settings, const ReuseInput& input,
                        const Previous<KeptSamples>& previous);

}  // namespace tarn
