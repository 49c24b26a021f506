// The error that is left in a mean of frames.
#pragma once

#include <optional>
#include <vector>

#include "core/image.h"

namespace tarn {

// Estimates it from how batches of consecutive frames differ. Frames that share history need batches that are
// long beside it; independent ones do not (1).
class MeanError {
  public:
    explicit MeanError(int batch_frames) : batch_frames_(batch_frames) {}

    // Frames of one shape, 3 channels.
    void add(const Image& frame);

    // The root of the mean variance of the mean's luminance, relative to its mean; none for less than two
    // batches.
    std::optional<double> relative_error() const;
    int batches() const { return batches_; }

  private:
    void finish_batch();

    int batch_frames_;
    int frames_in_batch_ = 0;
    int batches_ = 0;
    std::vector<double> batch_;       // sum of luminance, a pixel
    std::vector<double> mean_;        // of batches
    std::vector<double> deviations_;  // sum of squares (Welford)
};

}  // namespace tarn
