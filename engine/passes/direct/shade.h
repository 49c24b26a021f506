// Direct light, last step: the chosen samples light their pixels.
#pragma once

#include "passes/gbuffer.h"
#include "passes/reflected_light.h"
#include "passes/reuse/samples.h"
#include "passes/trace_rays.h"

namespace tarn {

// What is shaded: one of the first two with its visibility, or the sum that the last step of reuse made.
struct ShadeInput {
    const Samples* samples = nullptr;
    Answers answers;  // one a pixel, where the samples were traced after all reuse; null: what the reservoirs
                      // know
    ReflectedLight summed;
};

// The light of this slot's samples, added to `earlier` slots' of this frame, which is no more; none for the
// first slot.
ReflectedLight shade_direct(const FrameContext& frame, const GBuffer& gbuffer, const SampleSlot& slot,
                            const ShadeInput& input, const ReflectedLight& earlier);

}  // namespace tarn
