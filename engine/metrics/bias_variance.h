// What of an estimator's error is bias and what is noise, and how far the noise of neighbours hangs together.
#pragma once

#include <cstddef>
#include <span>

#include "core/image.h"

namespace tarn {

struct BiasVariance {
    int images = 0;
    double mse_of_mean = 0;  // of the mean of all images against the reference
    double variance = 0;     // of one image, averaged over channels and pixels
    // mse_of_mean - variance / images - reference_variance: unbiased, so it may come out below 0.
    double bias_squared = 0;
    double bias_squared_low = 0;  // 95 % confidence interval over seeds (jackknife with Student's t)
    double bias_squared_high = 0;
    // Autocorrelation of the error (image - mean of images) with the right and the lower neighbour, and the
    // same times the variance. 0 for independent pixels; MSE does not see blotches, this does.
    double neighbour_autocovariance = 0;
    double neighbour_autocorrelation = 0;
    std::size_t non_finite =
        0;  // pixels that were left out since any image or the reference is not finite there
};

// Splits the error of `images` (independent seeds, at least 3) against `reference`. `reference_variance` is
// the mean over pixels and channels of the variance of the reference's own mean; leave 0 where it is exact.
// Throws Error where sizes differ, fewer than 3 images are given or no pixel is finite.
BiasVariance split_bias_variance(const Image& reference, std::span<const Image> images,
                                 double reference_variance = 0.0);

}  // namespace tarn
