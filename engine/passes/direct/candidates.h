// Direct light, first step: a fresh sample a pixel, chosen out of candidates, and the ray that tests it.
#pragma once

#include "passes/gbuffer.h"
#include "passes/reuse/samples.h"

namespace tarn {

// Where candidates come from besides the light tables; null where the plan does not ask for them.
struct CandidateSources {
    Rows tiles;
    const RowBuffer* tree = nullptr;  // a table of the scene
    Rows brdf_hits;
};

Samples choose_candidates(const FrameContext& frame, const GBuffer& gbuffer, const SampleSlot& slot,
                          const CandidateSources& sources);

}  // namespace tarn
