// Errors of an image against a reference, both linear RGB: the classic sums.
#pragma once

#include <cstddef>

#include "core/image.h"

namespace tarn {

// What relMSE adds to the squared reference, and RMSPE and MAPE to the reference.
inline constexpr double REL_MSE_EPSILON = 0.01;

// a is the reference, b the image. Each term is averaged over the channels of a pixel, then over pixels.
struct ImageErrors {
    double mse = 0;              // mean (b - a)^2
    double rmse = 0;             // its root
    double rel_mse = 0;          // mean (b - a)^2 / (a^2 + 0.01)
    double rel_mse_trimmed = 0;  // the same without the 0.1 % of pixels where it is largest (rounded down)
    double rmspe = 0;            // 100 sqrt(mean ((b - a) / (a + 0.01))^2)
    double mape = 0;             // 100 mean |b - a| / (|a| + 0.01)
    double mean_ratio = 1;       // mean b / mean a: the energy; 1 where both are 0, infinite where a alone is
    std::size_t pixels = 0;      // that took part
    std::size_t non_finite = 0;  // with a NaN or an infinity in either image: left out
};

// Throws Error naming both sizes where the images differ in size or have other than 3 channels.
void check_comparable(const Image& reference, const Image& image);

// Whether all channels of pixel number `index` are finite in both images.
bool is_pixel_finite(const Image& reference, const Image& image, std::size_t index);

// Computes all sums on radiance * scale: the epsilons suppose exposure-normalized units. Throws as
// check_comparable does, and where no pixel is finite.
ImageErrors compute_image_errors(const Image& reference, const Image& image, double scale = 1.0);

}  // namespace tarn
