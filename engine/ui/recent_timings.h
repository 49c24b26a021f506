// Timings of the last frames, for a display that is steady yet follows changes.
#pragma once

#include <cstddef>
#include <deque>
#include <vector>

#include "frame/timings.h"

namespace tarn {

class RecentTimings {
  public:
    // Keeps the last `frames`.
    explicit RecentTimings(std::size_t frames = 32) : limit_(frames) {}

    void add(const FrameTimings& timings);
    void clear() { frames_.clear(); }

    // Medians over the frames that are kept; zero and empty without frames.
    FrameTimings medians() const;

  private:
    std::size_t limit_;
    std::deque<FrameTimings> frames_;
};

}  // namespace tarn
