// Direct light, last step: the chosen samples light their pixels.
#pragma once

#include "passes/gbuffer.h"
#include "passes/shade_input.h"

namespace tarn {

// The light of this slot's samples, added to `earlier` slots' of this frame, which is no more; none for the
// first slot.
ReflectedLight shade_direct(const FrameContext& frame, const GBuffer& gbuffer, const SampleSlot& slot,
                            const ShadeInput& input, const ReflectedLight& earlier);

}  // namespace tarn
