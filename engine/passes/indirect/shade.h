// Indirect light, last step: the chosen path samples light their pixels.
#pragma once

#include "passes/gbuffer.h"
#include "passes/reflected_light.h"
#include "passes/reuse/samples.h"
#include "passes/trace_rays.h"

namespace tarn {

// `answers`: one a pixel, where the samples were traced after all reuse; null: what the reservoirs know.
ReflectedLight shade_indirect(const FrameContext& frame, const GBuffer& gbuffer, const SampleSlot& slot,
                              const Samples& samples, const Answers& answers);

}  // namespace tarn
