// Moments against direct sums, Student's t against closed forms and tables.
#include "core/statistics.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

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
    const double normal = std::erfc(1.7 / std::sqrt(2.0));
    EXPECT_NEAR(student_t_two_sided_p_value(1.7, 1e7), normal, 1e-7);
    EXPECT_DOUBLE_EQ(student_t_two_sided_p_value(1.7, INFINITE), normal);
    EXPECT_NEAR(student_t_quantile(0.975, INFINITE), 1.959963984540054, 1e-14);
    EXPECT_EQ(student_t_two_sided_p_value(std::nan(""), 3.0), 0.0);
}

TEST(Sidak, keeps_the_family_at_its_significance) {
    EXPECT_DOUBLE_EQ(sidak_threshold(0.05, 1), 0.05);
    EXPECT_NEAR(sidak_threshold(0.05, 10), 0.005116196891823743, 1e-15);
    EXPECT_NEAR(1.0 - std::pow(1.0 - sidak_threshold(0.01, 3600), 3600), 0.01, 1e-9);
}

}  // namespace
}  // namespace tarn
