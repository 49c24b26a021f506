#include "metrics/mean_error.h"

#include <cmath>

#include "core/error.h"
#include "shared/math/colour.h"

namespace tarn {

void MeanError::add(const Image& frame) {
    TARN_ASSERT(frame.channels == 3, "{} channels, 3 are needed", frame.channels);
    batch_.resize(frame.pixel_count());
    mean_.resize(frame.pixel_count());
    deviations_.resize(frame.pixel_count());
    for (std::size_t i = 0; i < batch_.size(); ++i) {
        const float* rgb = &frame.values[3 * i];
        batch_[i] += double(luminance(vec3(rgb[0], rgb[1], rgb[2])));
    }
    if (++frames_in_batch_ == batch_frames_) finish_batch();
}

void MeanError::finish_batch() {
    ++batches_;
    for (std::size_t i = 0; i < batch_.size(); ++i) {
        const double value = batch_[i] / batch_frames_;
        const double before = mean_[i];
        mean_[i] += (value - before) / batches_;
        deviations_[i] += (value - before) * (value - mean_[i]);
        batch_[i] = 0.0;
    }
    frames_in_batch_ = 0;
}

std::optional<double> MeanError::relative_error() const {
    if (batches_ < 2) return std::nullopt;
    double variance = 0.0, light = 0.0;
    for (std::size_t i = 0; i < mean_.size(); ++i) {
        variance += deviations_[i] / (double(batches_) * (batches_ - 1));
        light += mean_[i];
    }
    if (!(light > 0.0)) return std::nullopt;
    return std::sqrt(variance * double(mean_.size())) / light;
}

}  // namespace tarn
