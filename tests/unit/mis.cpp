// MIS weights of a reuse step, by full enumeration of a toy world: the merged sample's contribution is
// unbiased for every heuristic that claims so, the weights sum to 1, and each classic mistake is found.
#include "shared/math/mis.h"

#include <gtest/gtest.h>

#include <array>
#include <set>

namespace tarn {
namespace {

constexpr int TECHNIQUES = 3;  // the pixel and two neighbours
constexpr int SAMPLES = 4;

// Three techniques with targets of different support over four samples. Each draws one sample in proportion
// to its own target, so that its contribution weight is exactly sum / target.
struct ToyStep {
    std::array<std::array<double, SAMPLES>, TECHNIQUES> target = {{
        {0.5, 1.0, 0.25, 0.0},
        {0.0, 2.0, 0.5, 1.0},  // cannot make sample 0, makes sample 3 that the pixel does not see
        {4.0, 0.0, 0.125, 0.0},
    }};
    std::array<double, TECHNIQUES> confidence = {4.0, 80.0, 17.0};
    std::array<bool, TECHNIQUES> joined = {true, true, true};
    std::array<double, SAMPLES> integrand = {1.5, 0.5, 2.0, 0.0};

    double pmf(int technique, int sample) const {
        double sum = 0.0;
        for (const double t : target[technique]) sum += t;
        return target[technique][sample] / sum;
    }
};

enum class Bug { NONE, SKIP_CONFIDENCE, COUNT_DEAD, TARGET_AT_NEIGHBOUR, DROP_NORMALIZATION };

// m of `technique` at `sample`; for constant and count the confidence, by which the end divides.
double weight(const ToyStep& s, uint mis, int technique, int sample, Bug bug) {
    const auto target = [&](int t) { return float(s.target[t][sample]); };
    const float own = bug == Bug::SKIP_CONFIDENCE && technique > 0 ? 1.0f : float(s.confidence[technique]);
    if (mis == MIS_ONE_OVER_M || mis == MIS_ONE_OVER_Z) return own;
    if (bug == Bug::DROP_NORMALIZATION) return 1.0;
    if (mis == MIS_BALANCE) {
        float sum = 0.0f;
        for (int t = 0; t < TECHNIQUES; ++t) {
            if (s.joined[t]) sum += balance_term(float(s.confidence[t]), target(t));
        }
        return bounded_ratio(balance_term(own, target(technique)), sum);
    }
    PairwiseStep step{float(s.confidence[0]), 0.0f};
    for (int t = 1; t < TECHNIQUES; ++t) {
        if (s.joined[t] || bug == Bug::COUNT_DEAD) step.neighbour_confidence += float(s.confidence[t]);
    }
    if (technique > 0) return pairwise_neighbour_weight(step, own, target(technique), target(0));
    double sum = pairwise_defensive_share(step);
    for (int t = 1; t < TECHNIQUES; ++t) {
        if (s.joined[t]) sum += pairwise_canonical_term(step, float(s.confidence[t]), target(t), target(0));
    }
    return sum;
}

double normalization(const ToyStep& s, uint mis, int sample, Bug bug) {
    if ((mis != MIS_ONE_OVER_M && mis != MIS_ONE_OVER_Z) || bug == Bug::DROP_NORMALIZATION) return 1.0;
    double sum = 0.0;
    for (int t = 0; t < TECHNIQUES; ++t) {
        if (!s.joined[t] && bug != Bug::COUNT_DEAD) continue;
        sum += mis == MIS_ONE_OVER_M ? s.confidence[t]
                                     : z_term(float(s.confidence[t]), float(s.target[t][sample]));
    }
    return sum;
}

// Expectation of integrand * W of the merged sample, given what each technique drew: the choice falls in
// proportion to the resampling weights.
double merge(const ToyStep& s, uint mis, const std::array<int, TECHNIQUES>& drawn, Bug bug) {
    std::array<double, TECHNIQUES> w{};
    std::array<double, TECHNIQUES> here{};
    double sum = 0.0;
    for (int t = 0; t < TECHNIQUES; ++t) {
        if (!s.joined[t]) continue;
        here[t] = s.target[0][drawn[t]];
        const double offered = s.target[bug == Bug::TARGET_AT_NEIGHBOUR ? t : 0][drawn[t]];
        w[t] = here[t] > 0.0 ? weight(s, mis, t, drawn[t], bug) * offered / s.pmf(t, drawn[t]) : 0.0;
        sum += w[t];
    }
    double expectation = 0.0;
    for (int t = 0; t < TECHNIQUES; ++t) {
        if (w[t] == 0.0) continue;
        const double contribution_weight = sum / (here[t] * normalization(s, mis, drawn[t], bug));
        expectation += w[t] / sum * s.integrand[drawn[t]] * contribution_weight;
    }
    return expectation;
}

// Over all draws of all techniques, relative to the sum of the integrand, less 1.
double relative_bias(const ToyStep& s, uint mis, Bug bug = Bug::NONE) {
    double expectation = 0.0;
    for (int a = 0; a < SAMPLES; ++a) {
        for (int b = 0; b < SAMPLES; ++b) {
            for (int c = 0; c < SAMPLES; ++c) {
                const double probability = s.pmf(0, a) * s.pmf(1, b) * s.pmf(2, c);
                if (probability > 0.0) expectation += probability * merge(s, mis, {a, b, c}, bug);
            }
        }
    }
    double truth = 0.0;
    for (const double f : s.integrand) truth += f;
    return expectation / truth - 1.0;
}

// Rounding of the weights in single precision.
constexpr double TOLERANCE = 1e-6;

TEST(Mis, CountBalanceAndPairwiseAreUnbiasedWithAnyNeighboursLeftOut) {
    for (const uint mis : {MIS_ONE_OVER_Z, MIS_BALANCE, MIS_PAIRWISE}) {
        for (const bool first : {false, true}) {
            for (const bool second : {false, true}) {
                ToyStep step;
                step.joined = {true, first, second};
                EXPECT_NEAR(relative_bias(step, mis), 0.0, TOLERANCE) << mis << first << second;
            }
        }
    }
}

TEST(Mis, ConstantDarkensWhereANeighbourCannotMakeTheSample) {
    EXPECT_LT(relative_bias(ToyStep{}, MIS_ONE_OVER_M), -0.1);
}

TEST(Mis, ConstantIsUnbiasedWhereAllSupportsAreAlike) {
    ToyStep step;
    step.target = {{{0.5, 1.0, 0.25, 0.0}, {1.0, 2.0, 0.5, 0.0}, {4.0, 1.0, 0.125, 0.0}}};
    EXPECT_NEAR(relative_bias(step, MIS_ONE_OVER_M), 0.0, TOLERANCE);
}

TEST(Mis, WeightsSumToOneAtEverySampleThatThePixelSees) {
    for (const uint mis : {MIS_BALANCE, MIS_PAIRWISE}) {
        for (int mask = 0; mask < 4; ++mask) {
            ToyStep step;
            step.joined = {true, (mask & 1) != 0, (mask & 2) != 0};
            for (int sample = 0; sample < 3; ++sample) {
                double sum = 0.0;
                for (int t = 0; t < TECHNIQUES; ++t) {
                    if (step.joined[t]) sum += weight(step, mis, t, sample, Bug::NONE);
                }
                EXPECT_NEAR(sum, 1.0, 1e-6) << "mis " << mis << " sample " << sample << " joined " << mask;
            }
        }
    }
}

TEST(Mis, WeightsSumToOneOverSixteenOrdersOfMagnitude) {
    for (const double scale : {1e-8, 1.0, 1e8}) {
        for (const uint mis : {MIS_BALANCE, MIS_PAIRWISE}) {
            ToyStep step;
            for (double& t : step.target[1]) t *= scale;
            double sum = 0.0;
            for (int t = 0; t < TECHNIQUES; ++t) sum += weight(step, mis, t, 2, Bug::NONE);
            EXPECT_NEAR(sum, 1.0, 1e-6) << "mis " << mis << " scale " << scale;
        }
    }
}

TEST(Mis, NegativeControlsAreDetectedForEveryHeuristic) {
    ToyStep step;
    step.joined[2] = false;
    for (const uint mis : {MIS_ONE_OVER_Z, MIS_BALANCE, MIS_PAIRWISE}) {
        for (const Bug bug : {Bug::SKIP_CONFIDENCE, Bug::TARGET_AT_NEIGHBOUR, Bug::DROP_NORMALIZATION}) {
            EXPECT_GT(std::abs(relative_bias(step, mis, bug)), 1e-2) << "mis " << mis << " bug " << int(bug);
        }
    }
    // Balance looks at its techniques one by one and has no sum of confidences to get wrong.
    for (const uint mis : {MIS_ONE_OVER_Z, MIS_PAIRWISE}) {
        EXPECT_GT(std::abs(relative_bias(step, mis, Bug::COUNT_DEAD)), 1e-2) << "mis " << mis;
    }
}

TEST(Mis, NothingIsDividedByZero) {
    EXPECT_EQ(bounded_ratio(0.0f, 0.0f), 0.0f);
    const PairwiseStep empty{0.0f, 0.0f};
    EXPECT_EQ(pairwise_defensive_share(empty), 0.0f);
    EXPECT_EQ(pairwise_neighbour_weight(empty, 0.0f, 0.0f, 0.0f), 0.0f);
    EXPECT_EQ(pairwise_canonical_term(empty, 0.0f, 0.0f, 0.0f), 0.0f);
}

TEST(ReuseRays, EveryRayOfAStepHasAPlaceOfItsOwn) {
    for (uint k = 1; k <= 9; ++k) {
        std::set<uint> balance, pairwise;
        for (uint owner = 0; owner <= k; ++owner) {
            for (uint looker = 0; looker <= k; ++looker) {
                if (owner == looker) continue;
                balance.insert(technique_ray_slot(MIS_BALANCE, k, owner, looker));
                if (owner == 0 || looker == 0)
                    pairwise.insert(technique_ray_slot(MIS_PAIRWISE, k, owner, looker));
            }
        }
        EXPECT_EQ(balance.size(), reuse_ray_count(MIS_BALANCE, true, false, k));
        EXPECT_EQ(*balance.rbegin() + 1, balance.size());
        EXPECT_EQ(pairwise.size(), reuse_ray_count(MIS_PAIRWISE, true, false, k));
        EXPECT_EQ(*pairwise.rbegin() + 1, pairwise.size());
    }
    EXPECT_EQ(reuse_ray_count(MIS_ONE_OVER_Z, true, false, 3), 4u);
    EXPECT_EQ(reuse_ray_count(MIS_BALANCE, false, true, 3), 3u);
    EXPECT_EQ(reuse_ray_count(MIS_ONE_OVER_M, true, false, 3), 0u);
}

}  // namespace
}  // namespace tarn
