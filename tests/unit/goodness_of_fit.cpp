// The normal and the chi-square distribution against closed forms and tables, the chi-square test on known
// counts.
#include "support/goodness_of_fit.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>
#include <vector>

namespace tarn {
namespace {

TEST(Normal, matches_tables) {
    EXPECT_DOUBLE_EQ(normal_two_sided_p_value(0.0), 1.0);
    EXPECT_NEAR(normal_two_sided_p_value(5.0) / (2.0 * 2.866515718791939e-7), 1.0, 1e-12);
    EXPECT_NEAR(normal_two_sided_p_value(-1.959963984540054), 0.05, 1e-15);
    EXPECT_EQ(normal_two_sided_p_value(std::nan("")), 0.0);
}

TEST(Normal, quantile_inverts_the_distribution) {
    EXPECT_NEAR(normal_quantile(0.975), 1.959963984540054, 1e-14);
    for (const double p : {1e-300, 1e-12, 1e-5, 0.02, 0.3, 0.5}) {
        EXPECT_NEAR(0.5 * normal_two_sided_p_value(normal_quantile(p)) / p, 1.0, 1e-12) << p;
    }
    EXPECT_NEAR(normal_quantile(0.7), -normal_quantile(0.3), 1e-14);
}

TEST(ChiSquare, has_closed_forms_for_even_degrees_of_freedom) {
    for (const double x : {0.01, 0.7, 3.0, 12.0, 90.0}) {
        EXPECT_NEAR(chi_square_p_value(x, 2.0) / std::exp(-x / 2), 1.0, 1e-12) << x;
        EXPECT_NEAR(chi_square_p_value(x, 4.0) / (std::exp(-x / 2) * (1 + x / 2)), 1.0, 1e-12) << x;
    }
    EXPECT_NEAR(chi_square_p_value(3.841458820694124, 1.0), 0.05, 1e-12);
    EXPECT_NEAR(chi_square_p_value(18.307038053275146, 10.0), 0.05, 1e-12);
    EXPECT_EQ(chi_square_p_value(0.0, 3.0), 1.0);
}

TEST(ChiSquare, compares_counts) {
    const std::array<double, 3> observed = {30, 50, 20};
    const std::array<double, 3> expected = {25, 50, 25};
    const ChiSquareTest test = chi_square_test(observed, expected);
    EXPECT_NEAR(test.statistic, 2.0, 1e-12);
    EXPECT_EQ(test.degrees_of_freedom, 2);
    EXPECT_NEAR(test.p_value, std::exp(-1.0), 1e-12);
}

TEST(ChiSquare, pools_bins_that_expect_too_little) {
    const std::array<double, 7> observed = {0, 3, 1, 0, 1, 52, 43};
    const std::array<double, 7> expected = {1, 1, 1, 1, 1, 50, 45};
    const ChiSquareTest test = chi_square_test(observed, expected);
    EXPECT_EQ(test.degrees_of_freedom, 2);
    EXPECT_NEAR(test.statistic, 4.0 / 50 + 4.0 / 45, 1e-12);
}

TEST(ChiSquare, calls_a_count_where_none_can_be_impossible) {
    const std::array<double, 2> observed = {1, 99};
    const std::array<double, 2> expected = {0, 100};
    EXPECT_EQ(chi_square_test(observed, expected).p_value, 0.0);
}

TEST(ChiSquare, accepts_a_fair_die_and_rejects_a_loaded_one) {
    std::mt19937 random(7);
    std::uniform_int_distribution<int> fair(0, 5);
    std::discrete_distribution<int> loaded({1.0, 1.0, 1.0, 1.0, 1.0, 1.1});
    const int throws = 60000;
    std::vector<double> fair_counts(6, 0.0), loaded_counts(6, 0.0);
    for (int i = 0; i < throws; ++i) {
        ++fair_counts[std::size_t(fair(random))];
        ++loaded_counts[std::size_t(loaded(random))];
    }
    const std::vector<double> expected(6, throws / 6.0);
    EXPECT_GT(chi_square_test(fair_counts, expected).p_value, 1e-3);
    EXPECT_LT(chi_square_test(loaded_counts, expected).p_value, 1e-6);
}

}  // namespace
}  // namespace tarn
