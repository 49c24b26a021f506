#include "bench/time_fit.h"

#include <algorithm>
#include <cmath>

namespace tarn {
namespace {

constexpr int TRIALS = 4;
constexpr double GROWTH = 4.0;        // of the dial, until a frame exceeds the budget
constexpr double GOOD_ENOUGH = 0.03;  // of the budget: below what a machine repeats
constexpr double FITTING = 1.1;       // of the budget: what still passes for it
constexpr double RESOLUTIONS[] = {0.75, 0.5, 0.375, 0.25};
// A frame that would take longer than that if it cost what its pixels do is not tried.
constexpr double HOPELESS = 1.5;

// The largest resolution at which the method's cheapest frame, of `full_ms` at full size, fits.
TimeFit lower_resolution(const RenderSettings& settings, double full_ms, double budget_ms,
                         const FrameTimer& time_frame_ms) {
    TimeFit fit{settings, 1.0, 1, full_ms};
    for (const double resolution : RESOLUTIONS) {
        if (fit.expected_ms <= FITTING * budget_ms) break;
        const bool is_last = resolution == *std::rbegin(RESOLUTIONS);
        if (!is_last && full_ms * resolution * resolution > HOPELESS * budget_ms) continue;
        fit.resolution = resolution;
        fit.expected_ms = time_frame_ms(settings, resolution);
    }
    return fit;
}

TimeFit fill_with_frames(const RenderSettings& settings, double frame_ms, double budget_ms) {
    const int frames = std::max(1, int(std::lround(budget_ms / std::max(frame_ms, 1e-6))));
    return {settings, 1.0, frames, frames * frame_ms};
}

struct DialPoint {
    double value = 0.0;
    double ms = 0.0;
};

// Where the line through two points meets the budget, kept between them.
double interpolate_value(const DialPoint& low, const DialPoint& high, double budget_ms) {
    const double share = (budget_ms - low.ms) / std::max(high.ms - low.ms, 1e-9);
    return std::clamp(std::floor(low.value + share * (high.value - low.value)), low.value, high.value);
}

}  // namespace

TimeFit fit_budget(const Method& method, double budget_ms, const FrameTimer& time_frame_ms) {
    if (method.dial.empty()) {
        const double ms = time_frame_ms(method.settings, 1.0);
        if (ms > FITTING * budget_ms) return lower_resolution(method.settings, ms, budget_ms, time_frame_ms);
        return fill_with_frames(method.settings, ms, budget_ms);
    }
    const Setting& dial = find_setting(method.dial);
    RenderSettings settings = method.settings;
    const auto time_value = [&](double value) {
        dial.set(settings, value);
        return DialPoint{value, time_frame_ms(settings, 1.0)};
    };
    DialPoint low = time_value(dial.minimum);
    if (low.ms >= budget_ms) return lower_resolution(settings, low.ms, budget_ms, time_frame_ms);
    DialPoint high = low;
    while (high.ms < budget_ms) {
        if (high.value >= dial.maximum) return fill_with_frames(settings, high.ms, budget_ms);
        low = high;
        high = time_value(std::min(GROWTH * high.value, dial.maximum));
    }
    for (int trial = 0; trial < TRIALS && high.value - low.value > 1.0; ++trial) {
        const DialPoint point = time_value(interpolate_value(low, high, budget_ms));
        if (point.value == low.value) break;
        (point.ms <= budget_ms ? low : high) = point;
        if (std::abs(point.ms - budget_ms) < GOOD_ENOUGH * budget_ms) {
            low = point;
            break;
        }
    }
    dial.set(settings, low.value);
    return {settings, 1.0, 1, low.ms};
}

}  // namespace tarn
