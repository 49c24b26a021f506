// Direct light: one candidate a pixel from a ray along its BRDF, for what light sampling seldom finds.
#pragma once

#include "passes/gbuffer.h"
#include "passes/reuse/samples.h"

namespace tarn {

// One row a pixel: the light sample that the ray met; see RayTracer::trace_lights.
Rows trace_brdf_candidates(const FrameContext& frame, const GBuffer& gbuffer, const SampleSlot& slot,
                           const World& world);

}  // namespace tarn
