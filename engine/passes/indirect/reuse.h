// Reuse of path samples: the steps of passes/reuse with indirect light's shaders.
#pragma once

#include "passes/reuse/reuse_step.h"

namespace tarn {

Samples reuse_indirect_over_time(const FrameContext& frame, const ReuseInput& input,
                                 const Previous<KeptSamples>& previous);
Samples filter_indirect_boiling(const FrameContext& frame, Samples samples);
Samples reuse_indirect_over_space(const FrameContext& frame, const ReuseInput& input, int iteration);

}  // namespace tarn
