// Distributions against closed forms and tables, moments against direct sums, the chi-square test on known
// counts.
#include "core/statistics.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

namespace tarn {
namespace {

constexpr double INFINITE = std::numeric_limits<double>::infinity();

TEST(RunningMoments, agree_with_the_direct_sums) {
    RunningMoments moments;
    for (const double value : {2.0, 4.0, 4.0, 4.0, 5.0, 5.0, 7.0, 9.0}) moments.add(value);
    EXPECT_EQ(moments.count(), 8);
    EXPECT_DOUBLE_EQ(moments.mean(), 5.0);
    EXPECT_NEAR(moments.variance(), 32.0 / 7.0, 1e-14);
    EXPECT_NEAR(moments.variance_of_mean(), 4.0 / 7.0, 1e-14);
}

TEST(RunningMoments, of_fewer_than_two_values_have_no_variance) {
    RunningMoments moments;
    EXPECT_EQ(moments.variance(), 0.0);
    moments.add(3.0);
    EXPECT_EQ(moments.mean(), 3.0);
    EXPECT_EQ(moments.variance(), 0.0);
}

TEST(RunningMoments, keep_their_digits_far_from_zero) {
    RunningMoments moments;
    for (const double value : {1e9 + 4, 1e9 + 7, 1e9 + 13, 1e9 + 16}) moments.add(value);
    EXPECT_NEAR(moments.variance(), 30.0, 1e-6);
}

TEST(RunningMoments, merge_as_if_all_values_had_come_to_one) {
    std::mt19937 random(1);
    std::normal_distribution<double> normal(3.0, 2.0);
    RunningMoments all, first, second, empty;
    for (int i = 0; i < 1000; ++i) {
        const double value = normal(random);
        all.add(value);
        (i < 300 ? first : second).add(value);
    }
    first.merge(second);
    first.merge(empty);
    empty.merge(first);
    EXPECT_EQ(empty.count(), 1000);
    EXPECT_NEAR(empty.mean(), all.mean(), 1e-12);
    EXPECT_NEAR(empty.variance(), all.variance(), 1e-11);
}

TEST(Normal, matches_tables) {
    EXPECT_DOUBLE_EQ(normal_cdf(0.0), 0.5);
    EXPECT_NEAR(normal_cdf(1.959963984540054), 0.975, 1e-15);
    EXPECT_NEAR(normal_cdf(-5.0) / 2.866515718791939e-7, 1.0, 1e-12);
    EXPECT_NEAR(normal_two_sided_p_value(-1.959963984540054), 0.05, 1e-15);
    EXPECT_EQ(normal_two_sided_p_value(std::nan("")), 0.0);
}

TEST(Normal, quantile_inverts_the_distribution) {
    EXPECT_NEAR(normal_quantile(0.975), 1.959963984540054, 1e-14);
    EXPECT_EQ(normal_quantile(0.0), -INFINITE);
    EXPECT_EQ(normal_quantile(1.0), INFINITE);
    for (const double p : {1e-300, 1e-12, 1e-5, 0.02, 0.3, 0.5}) {
        EXPECT_NEAR(normal_cdf(normal_quantile(p)) / p, 1.0, 1e-9) << p;
    }
    EXPECT_NEAR(normal_quantile(0.7), -normal_quantile(0.3), 1e-14);
}

TEST(StudentT, has_closed_forms_for_one_and_two_degrees_of_freedom) {
    for (const double t : {0.0, 0.3, 1.0, 4.0, 50.0, 1e4}) {
        EXPECT_NEAR(student_t_two_sided_p_value(t, 1.0), 1.0 - 2.0 / M_PI * std::atan(t), 1e-12) << t;
        EXPECT_NEAR(student_t_two_sided_p_value(-t, 2.0), 1.0 - t / std::sqrt(2.0 + t * t), 1e-12) << t;
    }
}

TEST(StudentT, matches_tables_and_becomes_normal) {
    EXPECT_NEAR(student_t_quantile(0.975, 10.0), 2.2281388519649385, 1e-10);
    EXPECT_NEAR(student_t_quantile(0.05, 5.0), -2.0150483733330242, 1e-10);
    EXPECT_NEAR(student_t_quantile(0.9995, 3.0), 12.923978636687485, 1e-8);
    EXPECT_NEAR(student_t_two_sided_p_value(1.7, 1e7), normal_two_sided_p_value(1.7), 1e-7);
    EXPECT_EQ(student_t_two_sided_p_value(1.7, INFINITE), normal_two_sided_p_value(1.7));
    EXPECT_EQ(student_t_two_sided_p_value(std::nan(""), 3.0), 0.0);
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

TEST(Sidak, keeps_the_family_at_its_significance) {
    EXPECT_DOUBLE_EQ(sidak_threshold(0.05, 1), 0.05);
    EXPECT_NEAR(sidak_threshold(0.05, 10), 0.005116196891823743, 1e-15);
    EXPECT_NEAR(1.0 - std::pow(1.0 - sidak_threshold(0.01, 3600), 3600), 0.01, 1e-9);
}

}  // namespace
}  // namespace tarn
