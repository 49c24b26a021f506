// The shared display transform over whole images, and automatic exposure.
#include "core/display.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/error.h"
#include "shared/math/colour.h"
#include "shared/math/display.h"

namespace tarn {

float encode_srgb(float linear) {
    return srgb_from_linear(linear);
}

float decode_srgb(float encoded) {
    return linear_from_srgb(encoded);
}

Image display_from_radiance(const Image& radiance, float exposure_ev) {
    TARN_ASSERT(radiance.channels == 3, "{} channels, 3 are needed", radiance.channels);
    const float scale = std::exp2(exposure_ev);
    Image display(radiance.width, radiance.height, 3);
    for (std::size_t i = 0; i < radiance.values.size(); i += 3) {
        const float* rgb = &radiance.values[i];
        const vec3 colour = display_colour(vec3(rgb[0], rgb[1], rgb[2]), scale);
        for (int c = 0; c < 3; ++c) display.values[i + c] = colour[c];
    }
    return display;
}

float auto_exposure_ev(const Image& radiance) {
    TARN_ASSERT(radiance.channels == 3, "{} channels, 3 are needed", radiance.channels);
    std::vector<float> log_luminances;
    log_luminances.reserve(radiance.pixel_count());
    for (std::size_t i = 0; i < radiance.values.size(); i += 3) {
        const float* rgb = &radiance.values[i];
        const float value = luminance(vec3(rgb[0], rgb[1], rgb[2]));
        if (std::isfinite(value) && value > 0.0f) log_luminances.push_back(std::log2(value));
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
