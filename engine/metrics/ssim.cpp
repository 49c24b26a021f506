// SSIM from five filtered planes: means, squares and the product.
#include "metrics/ssim.h"

#include <algorithm>
#include <limits>

#include "metrics/convolve.h"
#include "metrics/image_error.h"
#include "shared/math/colour.h"

namespace tarn {
namespace {

Plane luma_of(const Image& source, const Image& other) {
    Plane luma(source.width, source.height);
    for (std::size_t i = 0; i < source.pixel_count(); ++i) {
        if (!is_pixel_finite(source, other, i)) continue;
        const auto channel = [&](std::size_t c) { return std::clamp(source.values[3 * i + c], 0.0f, 1.0f); };
        luma.values[i] = luminance(vec3(channel(0), channel(1), channel(2)));
    }
    return luma;
}

Plane product(const Plane& a, const Plane& b) {
    Plane result = a;
    for (std::size_t i = 0; i < a.values.size(); ++i) result.values[i] *= b.values[i];
    return result;
}

// Takes the common mean off both planes and returns it: variances are differences of squares, which lose
// digits far from zero.
double centre(Plane& a, Plane& b) {
    double sum = 0;
    for (std::size_t i = 0; i < a.values.size(); ++i) sum += double(a.values[i]) + b.values[i];
    const float mean = float(sum / (2.0 * double(a.values.size())));
    for (std::size_t i = 0; i < a.values.size(); ++i) {
        a.values[i] -= mean;
        b.values[i] -= mean;
    }
    return mean;
}

}  // namespace

double compute_ssim(const Image& reference, const Image& image) {
    check_comparable(reference, image);
    constexpr double C1 = 0.01 * 0.01;
    constexpr double C2 = 0.03 * 0.03;
    const Kernel window = gaussian_kernel(1.5, 5);
    Plane a = luma_of(reference, image);
    Plane b = luma_of(image, reference);
    const double offset = centre(a, b);
    const Plane mean_a = correlate(a, window, window);
    const Plane mean_b = correlate(b, window, window);
    const Plane mean_aa = correlate(product(a, a), window, window);
    const Plane mean_bb = correlate(product(b, b), window, window);
    const Plane mean_ab = correlate(product(a, b), window, window);
    double sum = 0;
    std::size_t count = 0;
    for (std::size_t i = 0; i < a.values.size(); ++i) {
        if (!is_pixel_finite(reference, image, i)) continue;
        const double ma = mean_a.values[i];
        const double mb = mean_b.values[i];
        const double variances = double(mean_aa.values[i]) - ma * ma + double(mean_bb.values[i]) - mb * mb;
        const double covariance = double(mean_ab.values[i]) - ma * mb;
        const double la = ma + offset;
        const double lb = mb + offset;
        sum += (2 * la * lb + C1) * (2 * covariance + C2) / ((la * la + lb * lb + C1) * (variances + C2));
        ++count;
    }
    return count == 0 ? std::numeric_limits<double>::quiet_NaN() : sum / double(count);
}

}  // namespace tarn
