// Direct light, after reuse over time: drops the few reservoirs that outweigh their neighbourhood by far.
#pragma once

#include "passes/direct/direct_frame.h"

namespace tarn {

class BoilingFilterPass {
  public:
    BoilingFilterPass(ProgramLibrary& programs, int width_px, int height_px);

    // In place, by `settings.boiling_filter` (Wyman and Panteleev, "Rearchitecting Spatiotemporal Resampling
    // for Production", 2021). Darkens: what it drops is not given back.
    void record(const DirectFrame& direct, const RowBuffer& reservoirs);

  private:
    ProgramLibrary& programs_;
    int width_px_;
    int height_px_;
};

}  // namespace tarn
