// Timings of the last frames, for a display that is steady yet follows changes.
#pragma once

#include <cstddef>
#include <deque>
#include <vector>

#include "tarn_names.h"

namespace game {

struct FrameCost {
    double frame_ms = 0.0;
    std::vector<PassTime> passes;

    // While rays were traced, ms.
    double compute_tracing_ms() const;
};

class RecentTimings {
  public:
    // Keeps the last `frames`.
    explicit RecentTimings(std::size_t frames = 32) : limit_(frames) {}

    void add(const FrameReport& report);
    void clear() { frames_.clear(); }

    // Medians over the frames that are kept, of each pass over the frames in which it ran; zero and empty
    // without frames.
    FrameCost compute_medians() const;

  private:
    std::size_t limit_;
    std::deque<FrameCost> frames_;
};

}  // namespace game
