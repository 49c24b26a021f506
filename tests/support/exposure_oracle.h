// Automatic exposure by the words of its rule: all pixels sorted, no histogram. And pictures that are hard to
// expose.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <vector>

#include "core/image.h"

namespace tarn::test {

// A bin of the histogram is a sixteenth of an octave: 0.0875 stops at most. The oracle has none.
constexpr float EXPOSURE_BIN_STOPS = 0.09f;

inline std::vector<float> sort_brightest_channels(const Image& image) {
    std::vector<float> sorted;
    for (std::size_t i = 0; i < image.values.size(); i += 3) {
        const float* rgb = &image.values[i];
        if (!std::isfinite(rgb[0]) || !std::isfinite(rgb[1]) || !std::isfinite(rgb[2])) continue;
        const float brightest = std::max({rgb[0], rgb[1], rgb[2]});
        if (brightest > 0.0f) sorted.push_back(brightest);
    }
    std::sort(sorted.begin(), sorted.end());
    return sorted;
}

// How many pixels of `sorted` are brighter than white at this EV, and no lamp (64 times the middle, or more).
inline float share_of_clipped(const std::vector<float>& sorted, float ev, float white_level = 2.0f,
                              float up_to = INFINITY) {
    const float white = white_level * std::exp2(-ev);
    const auto clipped = std::count_if(sorted.begin(), sorted.end(),
                                       [&](float b) { return b > white * 1.0001f && b < up_to; });
    return float(clipped) / float(sorted.size());
}

inline float find_middle_by_sorting(const std::vector<float>& sorted) {
    const std::size_t quarter = sorted.size() / 4;
    double sum = 0.0;
    for (std::size_t i = quarter; i < sorted.size() - quarter; ++i) sum += std::log2(sorted[i]);
    return float(sum / double(sorted.size() - 2 * quarter));
}

inline float find_exposure_by_sorting(const Image& image, float white_level = 2.0f) {
    const std::vector<float> sorted = sort_brightest_channels(image);
    if (sorted.empty()) return 0.0f;
    const float middle = find_middle_by_sorting(sorted);
    const std::size_t n = sorted.size();
    const auto count_from = [&](float level) {
        return std::size_t(sorted.end() - std::lower_bound(sorted.begin(), sorted.end(), level));
    };
    const std::size_t lamps = count_from(std::exp2(middle + 6.0f));
    const float bright_share = float(count_from(std::exp2(middle) * white_level / 0.18f)) / float(n);
    const std::size_t allowed = std::size_t(0.02 * double(n));
    const auto white = [&](std::size_t clipped) {
        return std::log2(sorted[n - 1 - std::min(n - 1, clipped)]);
    };
    const float many = std::clamp((bright_share - 0.1f) / 0.1f, 0.0f, 1.0f);
    const float level = std::lerp(white(allowed + lamps), white(allowed), many);
    return std::clamp(std::min(std::log2(0.18f) - middle, std::log2(white_level) - level), -20.0f, 20.0f);
}

}  // namespace tarn::test
