#include "support/goodness_of_fit.h"

#include <algorithm>
#include <boost/math/special_functions/erf.hpp>
#include <boost/math/special_functions/gamma.hpp>
#include <cmath>
#include <limits>
#include <numeric>
#include <vector>

#include "core/error.h"

namespace tarn {
namespace {

constexpr double INFINITE = std::numeric_limits<double>::infinity();

}  // namespace

double normal_quantile(double p) {
    TARN_ASSERT(p > 0.0 && p < 1.0, "p is {}, more than 0 and less than 1 is needed", p);
    return -std::sqrt(2.0) * boost::math::erfc_inv(2.0 * p);
}

double normal_two_sided_p_value(double z) {
    return std::isnan(z) ? 0.0 : std::erfc(std::abs(z) / std::sqrt(2.0));
}

double chi_square_p_value(double statistic, double degrees_of_freedom) {
    TARN_ASSERT(degrees_of_freedom > 0.0, "degrees_of_freedom is {}", degrees_of_freedom);
    if (std::isnan(statistic) || std::isinf(statistic)) return 0.0;
    return boost::math::gamma_q(0.5 * degrees_of_freedom, 0.5 * std::max(statistic, 0.0));
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

}  // namespace tarn
