// Moments, quantiles and Student's t; the distributions come from Boost.Math.
#include "core/statistics.h"

#include <algorithm>
#include <boost/math/distributions/students_t.hpp>
#include <boost/math/special_functions/beta.hpp>
#include <cmath>
#include <vector>

#include "core/error.h"

namespace tarn {

void RunningMoments::add(double value) {
    ++count_;
    const double deviation = value - mean_;
    mean_ += deviation / double(count_);
    squared_deviations_ += deviation * (value - mean_);
}

void RunningMoments::merge(const RunningMoments& other) {
    if (other.count_ == 0) return;
    const double total = double(count_ + other.count_);
    const double shift = other.mean_ - mean_;
    squared_deviations_ +=
        other.squared_deviations_ + shift * shift * double(count_) * double(other.count_) / total;
    mean_ += shift * double(other.count_) / total;
    count_ += other.count_;
}

double RunningMoments::variance() const {
    return count_ < 2 ? 0.0 : squared_deviations_ / double(count_ - 1);
}

double RunningMoments::variance_of_mean() const {
    return count_ < 2 ? 0.0 : variance() / double(count_);
}

double quantile(std::vector<double> values, double q) {
    if (values.empty()) return 0.0;
    std::sort(values.begin(), values.end());
    const double position = q * double(values.size() - 1);
    const auto lower = std::size_t(std::floor(position));
    const std::size_t upper = std::min(lower + 1, values.size() - 1);
    return values[lower] + (values[upper] - values[lower]) * (position - double(lower));
}

double student_t_two_sided_p_value(double t, double degrees_of_freedom) {
    if (std::isnan(t)) return 0.0;
    if (std::isinf(degrees_of_freedom)) return std::erfc(std::abs(t) / std::sqrt(2.0));
    TARN_ASSERT(degrees_of_freedom > 0.0, "degrees_of_freedom is {}", degrees_of_freedom);
    if (std::isinf(t)) return 0.0;
    const double x = degrees_of_freedom / (degrees_of_freedom + t * t);
    return boost::math::ibeta(0.5 * degrees_of_freedom, 0.5, x);
}

double student_t_quantile(double p, double degrees_of_freedom) {
    TARN_ASSERT(p > 0.0 && p < 1.0, "p is {}, more than 0 and less than 1 is needed", p);
    return boost::math::quantile(boost::math::students_t(degrees_of_freedom), p);
}

double sidak_threshold(double significance, std::int64_t test_count) {
    TARN_ASSERT(test_count > 0, "test_count is {}", test_count);
    return -std::expm1(std::log1p(-significance) / double(test_count));
}

}  // namespace tarn
