// Direct light, reuse over time: the fresh sample of a pixel and what the same surface kept in the last
// frame.
#pragma once

#include "passes/direct/reuse_step.h"

namespace tarn {

class TemporalPass {
  public:
    explicit TemporalPass(ReuseStep& step) : step_(step) {}

    // Merges `io.in` with the last frame's `past` into `io.out`; without `has_past` it holds nothing
    // useful, and `io.in` passes through alone.
    void record(const DirectFrame& direct, const ReuseStep::Io& io, const Past<RowBuffer>& past,
                bool has_past);

  private:
    ReuseStep& step_;
};

}  // namespace tarn
