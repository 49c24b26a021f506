// After reuse over time: drops the few samples that outweigh their neighbourhood by far.
#pragma once

#include "passes/reuse/samples.h"

namespace tarn {

// By `settings.boiling_filter` (Wyman and Panteleev, "Rearchitecting Spatiotemporal Resampling for
// Production", 2021). Darkens: what it drops is not given back. Works in the memory of `samples`, which are
// no more.
Samples filter_boiling(const FrameContext& frame, const ReuseShaders& shaders, const ReuseSettings& settings,
                       Samples samples);

}  // namespace tarn
