#include "reference/film.h"

#include <cmath>

#include "shared/math/colour.h"

namespace tarn {
namespace {

constexpr glm::dvec3 LUMINANCE(LUMINANCE_WEIGHTS);
// Pixels darker than this share of the mean count as if they were that bright.
constexpr double DARK_SHARE = 0.01;

}  // namespace

glm::dvec3 Film::Pixel::variance_of_mean() const {
    if (count < 2) return glm::dvec3(0.0);
    return squared_deviations / (double(count) * double(count - 1));
}

Film::Film(int width, int height)
    : width_(width), height_(height), pixels_(std::size_t(width) * std::size_t(height)) {}

void Film::add(std::size_t pixel, const glm::vec3& radiance) {
    Pixel& p = pixels_[pixel];
    if (!is_finite3(radiance)) {
        ++p.non_finite;
        return;
    }
    ++p.count;
    const glm::dvec3 value(radiance);
    const glm::dvec3 before = value - p.mean;
    p.mean += before / double(p.count);
    p.squared_deviations += before * (value - p.mean);
}

Image Film::mean() const {
    Image image(width_, height_, 3);
    for (std::size_t i = 0; i < pixels_.size(); ++i) {
        for (int c = 0; c < 3; ++c) image.values[i * 3 + std::size_t(c)] = float(pixels_[i].mean[c]);
    }
    return image;
}

Image Film::variance_of_mean() const {
    Image image(width_, height_, 3);
    for (std::size_t i = 0; i < pixels_.size(); ++i) {
        const glm::dvec3 variance = pixels_[i].variance_of_mean();
        for (int c = 0; c < 3; ++c) image.values[i * 3 + std::size_t(c)] = float(variance[c]);
    }
    return image;
}

std::uint64_t Film::non_finite() const {
    std::uint64_t count = 0;
    for (const Pixel& p : pixels_) count += p.non_finite;
    return count;
}

double Film::relative_error() const {
    double total = 0.0;
    for (const Pixel& p : pixels_) total += glm::dot(LUMINANCE, p.mean);
    const double floor = DARK_SHARE * total / double(pixels_.size());
    double sum = 0.0;
    for (const Pixel& p : pixels_) {
        // Channels of one sample vary together; adding their deviations, not their variances, is on the safe
        // side.
        const double deviation = glm::dot(LUMINANCE, glm::sqrt(p.variance_of_mean()));
        const double luminance = glm::dot(LUMINANCE, p.mean);
        const double scale = luminance * luminance + floor * floor;
        if (scale > 0.0) sum += deviation * deviation / scale;
    }
    return std::sqrt(sum / double(pixels_.size()));
}

}  // namespace tarn
