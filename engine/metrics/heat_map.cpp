// A colour ramp built in CIELAB: even steps of lightness, hue turning from violet to yellow, chroma highest
// midway.
#include "metrics/heat_map.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "core/display.h"
#include "core/error.h"

namespace tarn {
namespace {

using Rgb = std::array<float, 3>;
constexpr std::size_t STEPS = 256;
constexpr Rgb LEFT_OUT = {0.0f, 1.0f, 1.0f};

float inverse_lab_curve(float t) {
    return t > 6.0f / 29.0f ? t * t * t : 3.0f * 36.0f / 841.0f * (t - 4.0f / 29.0f);
}

// CIELAB (D65) to display-encoded sRGB, clamped to its gamut.
Rgb srgb_from_lab(float lightness, float a, float b) {
    const float fy = (lightness + 16.0f) / 116.0f;
    const float x = 0.95047f * inverse_lab_curve(fy + a / 500.0f);
    const float y = inverse_lab_curve(fy);
    const float z = 1.08883f * inverse_lab_curve(fy - b / 200.0f);
    const float linear[3] = {3.2404542f * x - 1.5371385f * y - 0.4985314f * z,
                             -0.9692660f * x + 1.8760108f * y + 0.0415560f * z,
                             0.0556434f * x - 0.2040259f * y + 1.0572252f * z};
    Rgb rgb{};
    for (std::size_t c = 0; c < 3; ++c) rgb[c] = encode_srgb(std::clamp(linear[c], 0.0f, 1.0f));
    return rgb;
}

std::array<Rgb, STEPS> make_ramp() {
    std::array<Rgb, STEPS> ramp{};
    for (std::size_t i = 0; i < STEPS; ++i) {
        const float t = float(i) / float(STEPS - 1);
        const float hue_rad = std::numbers::pi_v<float> / 180.0f * (-60.0f + 160.0f * t);
        const float arch = std::max(std::sin(std::numbers::pi_v<float> * std::pow(t, 0.8f)), 0.0f);
        const float chroma = 68.0f * std::pow(arch, 0.8f) + 18.0f * t;
        ramp[i] = srgb_from_lab(97.0f * t, chroma * std::cos(hue_rad), chroma * std::sin(hue_rad));
    }
    ramp[0] = {0.0f, 0.0f, 0.0f};
    return ramp;
}

}  // namespace

Image heat_map(const Image& error_map) {
    TARN_ASSERT(error_map.channels == 1, "{} channels, 1 is needed", error_map.channels);
    static const std::array<Rgb, STEPS> ramp = make_ramp();
    Image picture(error_map.width, error_map.height, 3);
    for (std::size_t i = 0; i < error_map.values.size(); ++i) {
        const float value = error_map.values[i];
        const auto step = [&] {
            return std::size_t(std::lround(std::clamp(value, 0.0f, 1.0f) * float(STEPS - 1)));
        };
        const Rgb& colour = std::isnan(value) ? LEFT_OUT : ramp[step()];
        std::copy(colour.begin(), colour.end(), &picture.values[3 * i]);
    }
    return picture;
}

}  // namespace tarn
