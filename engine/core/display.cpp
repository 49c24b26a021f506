// Exposure, Khronos PBR Neutral tone mapping, sRGB.
#include "core/display.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/error.h"

namespace tarn {

float encode_srgb(float linear) {
    return linear <= 0.0031308f ? 12.92f * linear : 1.055f * std::pow(linear, 1.0f / 2.4f) - 0.055f;
}

float decode_srgb(float encoded) {
    return encoded <= 0.04045f ? encoded / 12.92f : std::pow((encoded + 0.055f) / 1.055f, 2.4f);
}

void tone_map_neutral(float rgb[3]) {
    constexpr float FRESNEL =
        0.04f;  // the white glare of a dielectric, taken off so that base colours stay as given
    constexpr float COMPRESSION_START = 0.8f - FRESNEL;
    constexpr float DESATURATION = 0.15f;
    const float darkest = std::min({rgb[0], rgb[1], rgb[2]});
    const float offset = darkest < 2.0f * FRESNEL ? darkest - darkest * darkest / (4.0f * FRESNEL) : FRESNEL;
    for (int c = 0; c < 3; ++c) rgb[c] -= offset;
    const float peak = std::max({rgb[0], rgb[1], rgb[2]});
    if (peak < COMPRESSION_START) return;
    const float headroom = 1.0f - COMPRESSION_START;
    const float compressed_peak = 1.0f - headroom * headroom / (peak + headroom - COMPRESSION_START);
    const float colour = 1.0f / (DESATURATION * (peak - compressed_peak) + 1.0f);
    for (int c = 0; c < 3; ++c) {
        const float compressed = rgb[c] * (compressed_peak / peak);
        rgb[c] = compressed_peak + (compressed - compressed_peak) * colour;
    }
}

Image display_from_radiance(const Image& radiance, float exposure_ev) {
    TARN_ASSERT(radiance.channels == 3, "{} channels, 3 are needed", radiance.channels);
    constexpr float BRIGHTEST = 1e9f;  // white after tone mapping, far from overflow
    const float scale = std::exp2(exposure_ev);
    Image display(radiance.width, radiance.height, 3);
    for (std::size_t i = 0; i < radiance.values.size(); i += 3) {
        float rgb[3];
        for (int c = 0; c < 3; ++c) {
            const float exposed = radiance.values[i + c] * scale;
            rgb[c] = exposed > 0.0f ? std::min(exposed, BRIGHTEST) : 0.0f;  // NaN becomes 0
        }
        tone_map_neutral(rgb);
        for (int c = 0; c < 3; ++c) display.values[i + c] = std::clamp(encode_srgb(rgb[c]), 0.0f, 1.0f);
    }
    return display;
}

float auto_exposure_ev(const Image& radiance) {
    TARN_ASSERT(radiance.channels == 3, "{} channels, 3 are needed", radiance.channels);
    std::vector<float> log_luminances;
    log_luminances.reserve(radiance.pixel_count());
    for (std::size_t i = 0; i < radiance.values.size(); i += 3) {
        const float* rgb = &radiance.values[i];
        const float luminance = 0.2126f * rgb[0] + 0.7152f * rgb[1] + 0.0722f * rgb[2];
        if (std::isfinite(luminance) && luminance > 0.0f) log_luminances.push_back(std::log2(luminance));
    }
    if (log_luminances.empty()) return 0.0f;
    std::sort(log_luminances.begin(), log_luminances.end());
    const std::size_t left_out = log_luminances.size() / 100;
    double sum = 0;
    for (std::size_t i = left_out; i < log_luminances.size() - left_out; ++i) sum += log_luminances[i];
    const double mean = sum / double(log_luminances.size() - 2 * left_out);
    return float(std::clamp(std::log2(0.18) - mean, -20.0, 20.0));
}

}  // namespace tarn
