// Moments of random numbers, their quantiles, Student's t, and many tests at once.
#pragma once

#include <cstdint>
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

// P(|T| >= |t|) for Student's t with `degrees_of_freedom` > 0 (infinity: the normal). NaN gives 0.
double student_t_two_sided_p_value(double t, double degrees_of_freedom);

// The t with P(T <= t) = p, for 0 < p < 1.
double student_t_quantile(double p, double degrees_of_freedom);

// The p value below which one of `test_count` independent tests disproves them all at `significance` (Sidak
// 1967): 1 - (1 - significance)^(1 / test_count).
double sidak_threshold(double significance, std::int64_t test_count);

}  // namespace tarn
