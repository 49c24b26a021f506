// Statistics for tests of random estimators: moments, distributions, goodness of fit, many tests at once.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace tarn {

// Mean and variance of numbers that come one by one (Welford); two of them merge as if all had come to one
// (Chan).
class RunningMoments {
  public:
    void add(double value);
    void merge(const RunningMoments& other);

    std::int64_t count() const { return count_; }
    double mean() const { return mean_; }
    // Unbiased variance of one number; 0 for fewer than two.
    double variance() const;
    // Variance of the mean of all numbers; 0 for fewer than two.
    double variance_of_mean() const;

  private:
    std::int64_t count_ = 0;
    double mean_ = 0;
    double squared_deviations_ = 0;
};

// The q-quantile of `values`, interpolated between neighbours, 0 <= q <= 1; 0 where there are none.
double quantile(std::vector<double> values, double q);

// P(Z <= z) for a standard normal Z; relative precision holds in the lower tail.
double normal_cdf(double z);

// The z with P(Z <= z) = p, for 0 < p < 1; -infinity at 0, +infinity at 1.
double normal_quantile(double p);

// P(|Z| >= |z|) for a standard normal Z. NaN counts as certain disagreement: 0.
double normal_two_sided_p_value(double z);

// P(|T| >= |t|) for Student's t with `degrees_of_freedom` > 0 (infinity: the normal). NaN gives 0.
double student_t_two_sided_p_value(double t, double degrees_of_freedom);

// The t with P(T <= t) = p, for 0 < p < 1.
double student_t_quantile(double p, double degrees_of_freedom);

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

// The p value below which one of `test_count` independent tests disproves them all at `significance` (Sidak
// 1967): 1 - (1 - significance)^(1 / test_count).
double sidak_threshold(double significance, std::int64_t test_count);

}  // namespace tarn
