#include "metrics/frame_mean.h"

namespace tarn {

void FrameMean::add(const Image& frame) {
    width_ = frame.width, height_ = frame.height, channels_ = frame.channels;
    sum_.resize(frame.values.size());
    for (std::size_t i = 0; i < sum_.size(); ++i) sum_[i] += double(frame.values[i]);
    ++frames_;
}

void FrameMean::merge(const FrameMean& other) {
    if (other.frames_ == 0) return;
    width_ = other.width_, height_ = other.height_, channels_ = other.channels_;
    sum_.resize(other.sum_.size());
    for (std::size_t i = 0; i < sum_.size(); ++i) sum_[i] += other.sum_[i];
    frames_ += other.frames_;
}

Image FrameMean::mean() const {
    Image mean(width_, height_, channels_);
    for (std::size_t i = 0; i < sum_.size(); ++i) mean.values[i] = float(sum_[i] / frames_);
    return mean;
}

}  // namespace tarn
