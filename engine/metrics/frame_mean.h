// Means of sequences of frames.
#pragma once

#include <vector>

#include "core/image.h"

namespace tarn {

// The mean of frames that come one by one; summed in double, so that a thousand of them lose nothing.
class FrameMean {
  public:
    void add(const Image& frame);
    // Of at least one frame.
    Image mean() const;

  private:
    Image latest_;  // for the shape
    std::vector<double> sum_;
    int frames_ = 0;
};

}  // namespace tarn
