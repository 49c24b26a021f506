// Direct light: one candidate a pixel from a ray along its BRDF, for what light sampling seldom finds.
#pragma once

#include "passes/gbuffer.h"
#include "passes/reuse/samples.h"

namespace tarn {

// HIT_ROWS rows a pixel: what the ray met.
Rows trace_brdf_candidates(const FrameContext& frame, const GBuffer& gbuffer, const SampleSlot& slot);

}  // namespace tarn
