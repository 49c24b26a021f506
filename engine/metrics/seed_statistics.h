// What K independent seeds say about a number: mean, interval, whether two runs differ, and the slope of a
// curve.
#pragma once

#include <span>

namespace tarn {

// A mean over seeds with its 95 % confidence interval (Student's t). Without spread to judge by (fewer than
// two values), low = high = mean.
struct Estimate {
    double mean = 0.0;
    double low = 0.0;
    double high = 0.0;
};

Estimate estimate_mean(std::span<const double> values);

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
