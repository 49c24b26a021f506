// Fresh samples learn whether their pixels see them.
#pragma once

#include "passes/reuse/samples.h"
#include "passes/trace_rays.h"

namespace tarn {

// `answers`: of the fresh samples' rays. With ReusePlan::drops_occluded those that are not seen are dropped.
// Works in the memory of `fresh`, which is no more.
Samples apply_initial_visibility(const FrameContext& frame, const ReuseShaders& shaders,
                                 const ReusePlan& plan, Samples fresh, const Answers& answers);

}  // namespace tarn
