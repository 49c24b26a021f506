// Direct light, reuse over space: the samples of a pixel and of some of its neighbours.
#pragma once

#include "passes/direct/reuse_step.h"

namespace tarn {

class SpatialPass {
  public:
    explicit SpatialPass(ReuseStep& step) : step_(step) {}

    // Merges `io.in` into `io.out`; `iteration` counts from 0.
    void record(const DirectFrame& direct, const ReuseStep::Io& io, int iteration);

  private:
    ReuseStep& step_;
};

}  // namespace tarn
