// Two passes over rows, written so that the inner loops run over neighbouring floats and vectorize.
#include "metrics/convolve.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace tarn {
namespace {

void add_scaled(float* target, const float* source, float weight, int count) {
    for (int x = 0; x < count; ++x) target[x] += weight * source[x];
}

void correlate_row(const float* source, float* target, int width, const Kernel& kernel,
                   std::vector<float>& padded) {
    const int radius = int(kernel.size() / 2);
    padded.resize(std::size_t(width + 2 * radius));
    std::fill_n(padded.begin(), radius, source[0]);
    std::copy_n(source, width, padded.begin() + radius);
    std::fill_n(padded.begin() + radius + width, radius, source[width - 1]);
    for (std::size_t tap = 0; tap < kernel.size(); ++tap)
        add_scaled(target, &padded[tap], kernel[tap], width);
}

}  // namespace

Plane correlate(const Plane& plane, const Kernel& horizontal, const Kernel& vertical) {
    Plane rows(plane.width, plane.height);
    std::vector<float> padded;
    for (int y = 0; y < plane.height; ++y)
        correlate_row(plane.row(y), rows.row(y), plane.width, horizontal, padded);

    Plane result(plane.width, plane.height);
    const int radius = int(vertical.size() / 2);
    for (int y = 0; y < plane.height; ++y) {
        for (int tap = 0; tap < int(vertical.size()); ++tap) {
            const int source_y = std::clamp(y + tap - radius, 0, plane.height - 1);
            add_scaled(result.row(y), rows.row(source_y), vertical[std::size_t(tap)], plane.width);
        }
    }
    return result;
}

Kernel gaussian_kernel(double deviation, int radius) {
    std::vector<double> weights;
    double sum = 0;
    for (int x = -radius; x <= radius; ++x) {
        weights.push_back(std::exp(-0.5 * x * x / (deviation * deviation)));
        sum += weights.back();
    }
    Kernel kernel;
    double rest = 1.0;
    for (const double weight : weights) {
        kernel.push_back(float(weight / sum));
        rest -= kernel.back();
    }
    // Rounding must not brighten: variances are small differences of such sums.
    kernel[std::size_t(radius)] += float(rest);
    return kernel;
}

}  // namespace tarn
