// Do counts and z values fit what theory expects? The chi-square test and the normal distribution.
#pragma once

#include <span>

namespace tarn {

// The z with P(Z <= z) = p, for 0 < p < 1.
double normal_quantile(double p);

// P(|Z| >= |z|) for a standard normal Z. NaN counts as certain disagreement: 0.
double normal_two_sided_p_value(double z);

// P(X >= statistic) for a chi-square X: the regularized upper incomplete gamma function Q(k / 2, x / 2).
double chi_square_p_value(double statistic, double degrees_of_freedom);

struct ChiSquareTest {
    double statistic = 0;
    int degrees_of_freedom = 0;
    double p_value = 1;
};

// Pearson's test of observed counts against expected counts of the same bins. Bins that expect fewer than
// `min_expected` are pooled, smallest first, since the distribution of the statistic is known only for larger
// ones. A count in a bin that expects nothing is impossible: p_value 0. Degrees of freedom: bins after
// pooling, less one.
ChiSquareTest chi_square_test(std::span<const double> observed, std::span<const double> expected,
                              double min_expected = 5.0);

}  // namespace tarn
