#include "api/exposure.h"

#include <algorithm>
#include <cmath>

#include "core/display.h"

namespace tarn::api {
namespace {

constexpr std::uint64_t INTERVAL = 4;  // frames between looks: each waits for the device
constexpr double TIME_S = 0.4;         // after which 1 / e of the way to the new exposure is left
constexpr std::size_t SAMPLES = 4096;

// Some thousand pixels, evenly spread.
Image sample_pixels(const Texture2D& radiance) {
    const std::vector<glm::vec4> texels = radiance.download<glm::vec4>();
    const std::size_t stride = std::max<std::size_t>(1, texels.size() / SAMPLES);
    Image image(int((texels.size() + stride - 1) / stride), 1, 3);
    for (std::size_t i = 0; i < image.pixel_count(); ++i) {
        for (int c = 0; c < 3; ++c) image.values[3 * i + std::size_t(c)] = texels[i * stride][c];
    }
    return image;
}

}  // namespace

float AutoExposure::follow(const Texture2D& radiance, std::uint64_t frame, double elapsed_s) {
    elapsed_s_ += std::max(0.0, elapsed_s);
    if (frame_ != 0 && frame < frame_ + INTERVAL) return exposure_ev_;
    const float target_ev = auto_exposure_ev(sample_pixels(radiance));
    const double way = frame_ == 0 ? 1.0 : 1.0 - std::exp(-elapsed_s_ / TIME_S);
    exposure_ev_ += float(way) * (target_ev - exposure_ev_);
    frame_ = frame;
    elapsed_s_ = 0.0;
    return exposure_ev_;
}

}  // namespace tarn::api
