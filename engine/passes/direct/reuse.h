// Reuse of light samples: the steps of passes/reuse with direct light's shaders.
#pragma once

#include "passes/reuse/initial_visibility.h"
#include "passes/reuse/reuse_step.h"

namespace tarn {

Samples apply_direct_visibility(const FrameContext& frame, Samples fresh, const Answers& answers);
Samples reuse_direct_over_time(const FrameContext& frame, const ReuseInput& input,
                               const Previous<KeptSamples>& previous);
Samples filter_direct_boiling(const FrameContext& frame, Samples samples);
Samples reuse_direct_over_space(const FrameContext& frame, const ReuseInput& input, int iteration);

}  // namespace tarn
