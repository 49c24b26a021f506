// What K independent seeds say about a number: mean, interval, whether two runs differ, and the slope of a
// curve.
#pragma once

#include <cmath>
#include <cstddef>
#include <span>

#include "core/statistics.h"

namespace tarn {

// A mean over seeds with its 95 % confidence interval (Student's t). Without spread to judge by (fewer than
// two values), low = high = mean.
struct Estimate {
    double mean = 0.0;
    double low = 0.0;
    double high = 0.0;
};

Estimate estimate_mean(std::span<const double> values);

// Any statistic of `count` seeds with its 95 % interval by the jackknife: `statistic(k)` computes it without
// seed k, `statistic(count)` with all of them. At least two seeds.
template <class Statistic>
Estimate estimate_jackknife(std::size_t count, const Statistic& statistic) {
    RunningMoments left_out;
    for (std::size_t k = 0; k < count; ++k) left_out.add(statistic(k));
    const double error = double(count - 1) * std::sqrt(left_out.variance_of_mean());
    const double reach = student_t_quantile(0.975, double(count - 1)) * error;
    const double value = statistic(count);
    return {value, value - reach, value + reach};
}

// The exponent s of y = c x^s by least squares over log x and log y. Points that are not positive and finite
// are passed over; NaN where fewer than two different x remain.
double fit_power_law(std::span<const double> x, std::span<const double> y);

// How far `after` lies from `before`, and how likely chance alone moves it as far.
struct Difference {
    double value = 0.0;    // mean of after - mean of before
    double p_value = 1.0;  // two-sided
};

// Student's paired test: before[i] and after[i] belong to the same seed and the same random numbers. Equal
// spans, at least two values; where nothing varies any change is certain (p = 0) and none is none (p = 1).
Difference test_paired(std::span<const double> before, std::span<const double> after);

// Welch's test of two independent samples of at least two values each.
Difference test_independent(std::span<const double> before, std::span<const double> after);

}  // namespace tarn
