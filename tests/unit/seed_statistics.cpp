// What K seeds say: intervals that cover as often as they claim, slopes, tests of a difference.
#include "metrics/seed_statistics.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

namespace tarn::test {
namespace {

std::vector<double> draw(std::mt19937& rng, double mean, double deviation, int count) {
    std::normal_distribution<double> normal(mean, deviation);
    std::vector<double> values;
    for (int i = 0; i < count; ++i) values.push_back(normal(rng));
    return values;
}

TEST(EstimateMean, CoversTheTruthAsOftenAsItClaims) {
    std::mt19937 rng(1);
    int covered = 0;
    constexpr int TRIALS = 4000;
    for (int i = 0; i < TRIALS; ++i) {
        const Estimate estimate = estimate_mean(draw(rng, 3.0, 2.0, 6));
        covered += estimate.low <= 3.0 && 3.0 <= estimate.high;
    }
    // 0.95 within four standard deviations of a binomial count.
    EXPECT_NEAR(double(covered) / TRIALS, 0.95, 4.0 * std::sqrt(0.95 * 0.05 / TRIALS));
}

TEST(EstimateMean, OneValueHasNoInterval) {
    const Estimate estimate = estimate_mean(std::vector<double>{7.0});
    EXPECT_EQ(estimate.low, 7.0);
    EXPECT_EQ(estimate.high, 7.0);
}

TEST(FitPowerLaw, FindsTheExponent) {
    const std::vector<double> x = {1, 2, 4, 8, 16};
    std::vector<double> y;
    for (const double value : x) y.push_back(3.0 * std::pow(value, -1.25));
    EXPECT_NEAR(fit_power_law(x, y), -1.25, 1e-12);
}

TEST(FitPowerLaw, PassesOverWhatHasNoLogarithm) {
    const std::vector<double> x = {1, 2, 4, 8}, y = {8, 4, -1, 1};
    EXPECT_NEAR(fit_power_law(x, y), -1.0, 1e-12);
    EXPECT_TRUE(std::isnan(fit_power_law(std::vector<double>{1, 2}, std::vector<double>{1, 0})));
}

TEST(PairedTest, SeesASmallChangeUnderLargeNoiseThatBothShare) {
    std::mt19937 rng(2);
    const std::vector<double> before = draw(rng, 1.0, 0.3, 8);
    std::vector<double> after;
    for (const double value : before) after.push_back(1.02 * value);
    EXPECT_LT(test_paired(before, after).p_value, 1e-3);
    EXPECT_GT(test_independent(before, after).p_value, 0.1);
}

TEST(PairedTest, WithoutSpreadAChangeIsCertainAndNoneIsNone) {
    const std::vector<double> a = {2, 2, 2}, b = {3, 3, 3};
    EXPECT_EQ(test_paired(a, a).p_value, 1.0);
    EXPECT_EQ(test_paired(a, b).p_value, 0.0);
    EXPECT_EQ(test_independent(a, a).p_value, 1.0);
    EXPECT_EQ(test_independent(a, b).p_value, 0.0);
}

TEST(IndependentTest, RejectsTruthAsOftenAsItClaims) {
    std::mt19937 rng(3);
    int rejected = 0;
    constexpr int TRIALS = 4000;
    for (int i = 0; i < TRIALS; ++i) {
        rejected += test_independent(draw(rng, 1.0, 0.2, 8), draw(rng, 1.0, 0.6, 8)).p_value < 0.05;
    }
    // Welch's freedom is an approximation: good to about a tenth of the level at eight values.
    EXPECT_NEAR(double(rejected) / TRIALS, 0.05, 0.005 + 4.0 * std::sqrt(0.05 * 0.95 / TRIALS));
}

}  // namespace
}  // namespace tarn::test
