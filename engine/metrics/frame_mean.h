// Means of sequences of frames.
#pragma once

#include <vector>

#include "core/image.h"

namespace tarn {

// The mean of frames that come one by one, all of one shape; summed in double, so that a thousand of them
// lose nothing.
class FrameMean {
  public:
    void add(const Image& frame);
    // Adds all frames of `other`.
    void merge(const FrameMean& other);
    int frames() const { return frames_; }
    // An empty image where there is no frame.
    Image mean() const;

  private:
    int width_ = 0, height_ = 0, channels_ = 0;
    std::vector<double> sum_;  // as Image::values
    int frames_ = 0;
};

}  // namespace tarn
