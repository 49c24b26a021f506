#include "metrics/frame_mean.h"

namespace tarn {

void FrameMean::add(const Image& frame) {
    sum_.resize(frame.values.size());
    for (std::size_t i = 0; i < sum_.size(); ++i) sum_[i] += frame.values[i];
    latest_ = frame;
    ++frames_;
}

Image FrameMean::mean() const {
    Image mean = latest_;
    for (std::size_t i = 0; i < sum_.size(); ++i) mean.values[i] = float(sum_[i] / frames_);
    return mean;
}

}  // namespace tarn
