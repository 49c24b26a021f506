// Separable convolution of planes, with the border's pixels repeated outwards.
#pragma once

#include <vector>

namespace tarn {

// A plane of floats, row 0 on top.
struct Plane {
    int width = 0;
    int height = 0;
    std::vector<float> values;

    Plane() = default;
    Plane(int width_px, int height_px)
        : width(width_px), height(height_px), values(std::size_t(width_px) * std::size_t(height_px), 0.0f) {}
    float* row(int y) { return &values[std::size_t(y) * std::size_t(width)]; }
    const float* row(int y) const { return &values[std::size_t(y) * std::size_t(width)]; }
};

// An odd number of weights; the middle one meets the pixel itself, the first one the pixel `radius` to the
// left.
using Kernel = std::vector<float>;

// Correlates `plane` with the product of a horizontal and a vertical kernel.
Plane correlate(const Plane& plane, const Kernel& horizontal, const Kernel& vertical);

// Samples of exp(-x^2 / (2 deviation^2)) for x = -radius..radius, with sum 1.
Kernel gaussian_kernel(double deviation, int radius);

}  // namespace tarn
