// Moments and distributions: series and continued fractions as in Abramowitz & Stegun, chapters 6 and 26.
#include "core/statistics.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <vector>

#include "core/error.h"

namespace tarn {
namespace {

constexpr double INFINITE = std::numeric_limits<double>::infinity();
constexpr double EPSILON = 1e-16;
constexpr double TINY = 1e-300;
constexpr int MAX_TERMS = 100'000;

// Lower regularized incomplete gamma P(a, x) by its power series (A&S 6.5.29), for x < a + 1.
double gamma_p_series(double a, double x) {
    double term = 1.0 / a;
    double sum = term;
    for (int n = 1; n < MAX_TERMS && term > EPSILON * sum; ++n) {
        term *= x / (a + n);
        sum += term;
    }
    return sum * std::exp(a * std::log(x) - x - std::lgamma(a));
}

// Upper regularized incomplete gamma Q(a, x) by its continued fraction (A&S 6.5.31, evaluated by Lentz's
// method).
double gamma_q_fraction(double a, double x) {
    double b = x + 1.0 - a;
    double c = 1.0 / TINY;
    double d = 1.0 / b;
    double value = d;
    for (int n = 1; n < MAX_TERMS; ++n) {
        const double numerator = -n * (n - a);
        b += 2.0;
        d = numerator * d + b;
        d = 1.0 / (std::abs(d) < TINY ? TINY : d);
        c = b + numerator / c;
        if (std::abs(c) < TINY) c = TINY;
        value *= c * d;
        if (std::abs(c * d - 1.0) < EPSILON) break;
    }
    return value * std::exp(a * std::log(x) - x - std::lgamma(a));
}

// Continued fraction of the incomplete beta function (A&S 26.5.8), for x < (a + 1) / (a + b + 2).
double beta_fraction(double a, double b, double x) {
    double c = 1.0;
    double d = 1.0 - (a + b) * x / (a + 1.0);
    d = 1.0 / (std::abs(d) < TINY ? TINY : d);
    double value = d;
    const auto step = [&](double numerator) {
        d = 1.0 + numerator * d;
        d = 1.0 / (std::abs(d) < TINY ? TINY : d);
        c = 1.0 + numerator / c;
        if (std::abs(c) < TINY) c = TINY;
        value *= c * d;
        return c * d;
    };
    for (int m = 1; m < MAX_TERMS; ++m) {
        step(m * (b - m) * x / ((a + 2 * m - 1) * (a + 2 * m)));
        if (std::abs(step(-(a + m) * (a + b + m) * x / ((a + 2 * m) * (a + 2 * m + 1))) - 1.0) < EPSILON)
            break;
    }
    return value;
}

// Regularized incomplete beta I_x(a, b).
double incomplete_beta(double a, double b, double x) {
    if (x <= 0.0) return 0.0;
    if (x >= 1.0) return 1.0;
    const double log_front =
        std::lgamma(a + b) - std::lgamma(a) - std::lgamma(b) + a * std::log(x) + b * std::log1p(-x);
    if (x < (a + 1.0) / (a + b + 2.0)) return std::exp(log_front) * beta_fraction(a, b, x) / a;
    return 1.0 - std::exp(log_front) * beta_fraction(b, a, 1.0 - x) / b;
}

// First guess of the normal quantile for p <= 1/2 (A&S 26.2.23), 4.5e-4 at worst.
double guess_normal_quantile(double p) {
    const double t = std::sqrt(-2.0 * std::log(p));
    const double numerator = 2.515517 + t * (0.802853 + t * 0.010328);
    const double denominator = 1.0 + t * (1.432788 + t * (0.189269 + t * 0.001308));
    return numerator / denominator - t;
}

}  // namespace

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

double normal_cdf(double z) {
    return 0.5 * std::erfc(-z / std::sqrt(2.0));
}

double normal_quantile(double p) {
    TARN_ASSERT(p >= 0.0 && p <= 1.0, "p is {}, 0..1 is needed", p);
    if (p == 0.0) return -INFINITE;
    if (p == 1.0) return INFINITE;
    if (p > 0.5) return -normal_quantile(1.0 - p);
    double z = guess_normal_quantile(p);
    for (int step = 0; step < 3; ++step) {  // Halley's method triples the correct digits
        const double density = std::exp(-0.5 * z * z) / std::sqrt(2.0 * M_PI);
        const double newton = (normal_cdf(z) - p) / density;
        z -= newton / (1.0 + 0.5 * z * newton);
    }
    return z;
}

double normal_two_sided_p_value(double z) {
    return std::isnan(z) ? 0.0 : std::erfc(std::abs(z) / std::sqrt(2.0));
}

double student_t_two_sided_p_value(double t, double degrees_of_freedom) {
    if (std::isnan(t)) return 0.0;
    if (std::isinf(degrees_of_freedom)) return normal_two_sided_p_value(t);
    TARN_ASSERT(degrees_of_freedom > 0.0, "degrees_of_freedom is {}", degrees_of_freedom);
    if (std::isinf(t)) return 0.0;
    return incomplete_beta(0.5 * degrees_of_freedom, 0.5, degrees_of_freedom / (degrees_of_freedom + t * t));
}

double student_t_quantile(double p, double degrees_of_freedom) {
    TARN_ASSERT(p > 0.0 && p < 1.0, "p is {}, more than 0 and less than 1 is needed", p);
    if (p > 0.5) return -student_t_quantile(1.0 - p, degrees_of_freedom);
    double low = 0.0;
    double high = 1.0;
    while (student_t_two_sided_p_value(high, degrees_of_freedom) > 2.0 * p) high *= 2.0;
    for (int step = 0; step < 200 && high - low > 1e-15 * high; ++step) {
        const double middle = 0.5 * (low + high);
        (student_t_two_sided_p_value(middle, degrees_of_freedom) > 2.0 * p ? low : high) = middle;
    }
    return -0.5 * (low + high);
}

double chi_square_p_value(double statistic, double degrees_of_freedom) {
    TARN_ASSERT(degrees_of_freedom > 0.0, "degrees_of_freedom is {}", degrees_of_freedom);
    if (std::isnan(statistic) || std::isinf(statistic)) return 0.0;
    if (statistic <= 0.0) return 1.0;
    const double a = 0.5 * degrees_of_freedom;
    const double x = 0.5 * statistic;
    return x < a + 1.0 ? 1.0 - gamma_p_series(a, x) : gamma_q_fraction(a, x);
}

ChiSquareTest chi_square_test(std::span<const double> observed, std::span<const double> expected,
                              double min_expected) {
    TARN_ASSERT(observed.size() == expected.size(), "{} observed bins, {} expected", observed.size(),
                expected.size());
    std::vector<std::size_t> order(expected.size());
    std::iota(order.begin(), order.end(), std::size_t(0));
    std::sort(order.begin(), order.end(),
              [&](std::size_t a, std::size_t b) { return expected[a] < expected[b]; });

    ChiSquareTest test;
    int bins = 0;
    double pooled_observed = 0;
    double pooled_expected = 0;
    const auto close_bin = [&] {
        const double difference = pooled_observed - pooled_expected;
        test.statistic += difference * difference / pooled_expected;
        pooled_observed = pooled_expected = 0;
        ++bins;
    };
    double remaining = std::accumulate(expected.begin(), expected.end(), 0.0);
    for (const std::size_t bin : order) {
        if (expected[bin] <= 0.0 && observed[bin] > 0.0) return {INFINITE, int(expected.size()) - 1, 0.0};
        pooled_observed += observed[bin];
        pooled_expected += expected[bin];
        remaining -= expected[bin];
        // A rest that is too small for a bin of its own joins the one that is being filled.
        if (pooled_expected >= min_expected && remaining >= min_expected) close_bin();
    }
    if (pooled_expected > 0.0) close_bin();
    test.degrees_of_freedom = std::max(bins - 1, 0);
    test.p_value =
        test.degrees_of_freedom == 0 ? 1.0 : chi_square_p_value(test.statistic, test.degrees_of_freedom);
    return test;
}

double sidak_threshold(double significance, std::int64_t test_count) {
    TARN_ASSERT(test_count > 0, "test_count is {}", test_count);
    return -std::expm1(std::log1p(-significance) / double(test_count));
}

}  // namespace tarn
