// Direct light: one candidate a pixel from a ray along its BRDF, for what light sampling seldom finds.
#pragma once

#include "passes/direct/direct_frame.h"

namespace tarn {

class BrdfCandidatesPass {
  public:
    BrdfCandidatesPass(ProgramLibrary& programs, int width_px, int height_px);

    // HIT_ROWS rows a pixel: what the ray met.
    const RowBuffer& record(const DirectFrame& direct);

    // Rays of the last batch.
    const RayBatchResult& result() const { return result_; }

  private:
    ProgramLibrary& programs_;
    int width_px_;
    int height_px_;
    RowBuffer rays_;
    RowBuffer hits_;
    RayBatchResult result_;
};

}  // namespace tarn
