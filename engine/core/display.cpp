// The shared display transform over whole images, and automatic exposure.
#include "core/display.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "core/error.h"
#include "core/glare.h"
#include "shared/math/colour.h"
#include "shared/math/display.h"
#include "shared/math/exposure.h"

namespace tarn {
namespace {

static_assert(std::uint32_t(ToneCurve::CLIP) == TONE_CLIP);
static_assert(std::uint32_t(ToneCurve::NEUTRAL) == TONE_NEUTRAL);
constexpr std::array<const char*, 2> TONE_CURVES = {"clip", "neutral"};

vec3 load_rgb(const float* rgb) {
    return vec3(rgb[0], rgb[1], rgb[2]);
}

void store_rgb(float* rgb, vec3 colour) {
    for (int c = 0; c < 3; ++c) rgb[c] = colour[c];
}

using BrightnessCounts = std::array<uint, EXPOSURE_BINS>;

BrightnessCounts count_brightness_of(const Image& radiance) {
    BrightnessCounts counts{};
    const int stride = exposure_stride(radiance.width, radiance.height);
    for (int y = 0; y < radiance.height; y += stride) {
        for (int x = 0; x < radiance.width; x += stride) {
            const int bin = exposure_bin(load_rgb(radiance.pixel(x, y)));
            if (bin >= 0) ++counts[std::size_t(bin)];
        }
    }
    return counts;
}

float find_middle_stops(const BrightnessCounts& counts, uint total) {
    double sum = 0.0, weights = 0.0;
    uint before = 0;
    for (int bin = 0; bin < EXPOSURE_BINS; ++bin) {
        const double weight = count_in_middle_half(before, counts[std::size_t(bin)], total);
        sum += weight * exposure_bin_middle(bin);
        weights += weight;
        before += counts[std::size_t(bin)];
    }
    return float(sum / weights);
}

// The lowest top of a bin that no more than `allowed` pixels exceed.
float find_white_stops(const BrightnessCounts& counts, uint allowed) {
    uint above = 0;
    int bin = EXPOSURE_BINS - 1;
    for (; bin > 0 && above + counts[std::size_t(bin)] <= allowed; --bin) above += counts[std::size_t(bin)];
    return exposure_bin_stops(bin + 1);
}

uint count_from(const BrightnessCounts& counts, float stops) {
    uint count = 0;
    for (int bin = 0; bin < EXPOSURE_BINS; ++bin) {
        if (exposure_bin_stops(bin) >= stops) count += counts[std::size_t(bin)];
    }
    return count;
}

}  // namespace

std::span<const char* const> tone_curve_names() {
    return TONE_CURVES;
}

ToneCurve parse_tone_curve(const std::string& name) {
    for (std::size_t i = 0; i < TONE_CURVES.size(); ++i) {
        if (name == TONE_CURVES[i]) return ToneCurve(i);
    }
    throw Error("tone curve '{}' is none of: {}, {}", name, TONE_CURVES[0], TONE_CURVES[1]);
}

float encode_srgb(float linear) {
    return srgb_from_linear(linear);
}

float decode_srgb(float encoded) {
    return linear_from_srgb(encoded);
}

Image display_from_radiance(const Image& radiance, float exposure_ev, const DisplayLook& look) {
    TARN_ASSERT(radiance.channels == 3, "{} channels, 3 are needed", radiance.channels);
    const float scale = std::exp2(exposure_ev);
    Image display(radiance.width, radiance.height, 3);
    for (std::size_t i = 0; i < radiance.values.size(); i += 3) {
        store_rgb(&display.values[i], expose(load_rgb(&radiance.values[i]), scale));
    }
    if (look.glare > 0.0f) add_glare_to(display, look.glare);
    for (std::size_t i = 0; i < display.values.size(); i += 3) {
        store_rgb(&display.values[i], encode_exposed(load_rgb(&display.values[i]), uint(look.tone)));
    }
    return display;
}

float auto_exposure_ev(const Image& radiance, ToneCurve tone) {
    TARN_ASSERT(radiance.channels == 3, "{} channels, 3 are needed", radiance.channels);
    const BrightnessCounts counts = count_brightness_of(radiance);
    uint total = 0;
    for (const uint count : counts) total += count;
    if (total == 0) return 0.0f;
    const uint allowed = uint(float(total) * EXPOSURE_CLIPPED_SHARE);
    ExposureLevels levels;
    levels.middle = find_middle_stops(counts, total);
    const uint lamps = count_from(counts, levels.middle + EXPOSURE_LAMP_STOPS);
    const uint bright = count_from(counts, find_bright_stops(levels.middle, uint(tone)));
    levels.bright_share = float(bright) / float(total);
    levels.white = find_white_stops(counts, allowed);
    levels.white_lit = find_white_stops(counts, allowed + lamps);
    return choose_exposure_ev(levels, uint(tone));
}

float measuring_exposure_ev(const Image& radiance) {
    TARN_ASSERT(radiance.channels == 3, "{} channels, 3 are needed", radiance.channels);
    std::vector<float> log_luminances;
    log_luminances.reserve(radiance.pixel_count());
    for (std::size_t i = 0; i < radiance.values.size(); i += 3) {
        const float value = luminance(load_rgb(&radiance.values[i]));
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
