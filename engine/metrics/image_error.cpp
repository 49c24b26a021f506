// MSE, relMSE, RMSPE, MAPE and the ratio of means.
#include "metrics/image_error.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <vector>

#include "core/error.h"

namespace tarn {
namespace {

constexpr std::size_t TRIMMED_SHARE = 1000;  // one pixel in so many is left out of the trimmed relMSE

// The sum without its largest terms. Takes `terms` apart.
double trimmed_mean(std::vector<double>& terms) {
    const std::size_t kept = terms.size() - terms.size() / TRIMMED_SHARE;
    std::nth_element(terms.begin(), terms.begin() + std::ptrdiff_t(kept - 1), terms.end());
    return std::accumulate(terms.begin(), terms.begin() + std::ptrdiff_t(kept), 0.0) / double(kept);
}

double ratio_of_means(double reference_sum, double image_sum) {
    if (reference_sum != 0.0) return image_sum / reference_sum;
    return image_sum == 0.0 ? 1.0 : std::numeric_limits<double>::infinity();
}

}  // namespace

void check_comparable(const Image& reference, const Image& image) {
    if (reference.channels != 3 || image.channels != 3) {
        throw Error("the reference has {} channels and the image {}, both need 3", reference.channels,
                    image.channels);
    }
    if (reference.width != image.width || reference.height != image.height) {
        throw Error("the reference has {} x {} pixels, the image {} x {}: only pictures of one size compare",
                    reference.width, reference.height, image.width, image.height);
    }
}

bool is_pixel_finite(const Image& reference, const Image& image, std::size_t index) {
    const auto finite = [](float value) { return std::isfinite(value); };
    const float* a = &reference.values[3 * index];
    const float* b = &image.values[3 * index];
    return std::all_of(a, a + 3, finite) && std::all_of(b, b + 3, finite);
}

ImageErrors compute_image_errors(const Image& reference, const Image& image, double scale) {
    check_comparable(reference, image);
    ImageErrors errors;
    std::vector<double> relative_squares;
    relative_squares.reserve(reference.pixel_count());
    double reference_sum = 0;
    double image_sum = 0;
    for (std::size_t i = 0; i < reference.pixel_count(); ++i) {
        if (!is_pixel_finite(reference, image, i)) {
            ++errors.non_finite;
            continue;
        }
        double relative_square = 0;
        for (std::size_t c = 0; c < 3; ++c) {
            const double a = scale * reference.values[3 * i + c];
            const double b = scale * image.values[3 * i + c];
            const double square = (b - a) * (b - a);
            reference_sum += a;
            image_sum += b;
            errors.mse += square;
            relative_square += square / (a * a + REL_MSE_EPSILON);
            errors.rmspe += square / ((a + REL_MSE_EPSILON) * (a + REL_MSE_EPSILON));
            errors.mape += std::abs(b - a) / (std::abs(a) + REL_MSE_EPSILON);
        }
        relative_squares.push_back(relative_square / 3.0);
    }
    errors.pixels = relative_squares.size();
    if (errors.pixels == 0)
        throw Error("none of the {} pixels is finite in both pictures", reference.pixel_count());
    const double terms = 3.0 * double(errors.pixels);
    errors.mse /= terms;
    errors.rmse = std::sqrt(errors.mse);
    errors.rmspe = 100.0 * std::sqrt(errors.rmspe / terms);
    errors.mape = 100.0 * errors.mape / terms;
    errors.mean_ratio = ratio_of_means(reference_sum, image_sum);
    errors.rel_mse =
        std::accumulate(relative_squares.begin(), relative_squares.end(), 0.0) / double(errors.pixels);
    errors.rel_mse_trimmed = trimmed_mean(relative_squares);
    return errors;
}

}  // namespace tarn
