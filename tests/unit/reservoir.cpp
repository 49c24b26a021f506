// Streaming resampled importance sampling by full enumeration of a small world, and what a reservoir does at
// its edges.
#include "shared/math/reservoir.h"

#include <gtest/gtest.h>

#include <array>
#include <limits>

#include "shared/math/light_sample.h"

namespace tarn {
namespace {

// ---- Enumeration
// --------------------------------------------------------------------------------------------------

// A world of four samples. The third is dead: it can be drawn, but target and integrand are 0 there. target /
// pdf is 1, 2, 0 and 3, so that each choice has a rational probability that a grid of random numbers meets
// exactly.
struct ToyWorld {
    static constexpr int SIZE = 4;
    std::array<double, SIZE> pdf = {0.4, 0.3, 0.2, 0.1};
    std::array<double, SIZE> target = {0.4, 0.6, 0.0, 0.3};
    std::array<double, SIZE> integrand = {2.0, 1.5, 0.0, 0.5};
};

enum class Bug { NONE, FORGET_ONE_OVER_M, COUNT_LIVE_CANDIDATES_ONLY, FORGET_ONE_OVER_PDF };

constexpr int CANDIDATE_COUNT = 3;
// Midpoints of u for the second and the third candidate: the least common multiples of the possible sums of
// two (2..6) and of three (3..9) weights.
constexpr int SECOND_STEPS = 60;
constexpr int THIRD_STEPS = 2520;

// A reservoir being filled with samples that are numbers.
struct Stream {
    LiveReservoir live = empty_live_reservoir();
    uint chosen = INVALID_INDEX;

    uint offer(int sample, float target, float weight, float u) {
        const uint outcome = offer_candidate(live, target, weight, u);
        if (outcome == OFFER_TAKEN) chosen = uint(sample);
        return outcome;
    }
};

// integrand * W after the given candidates and random numbers.
double resample(const ToyWorld& world, const std::array<int, CANDIDATE_COUNT>& candidates, const vec3& u,
                Bug bug) {
    int live_count = 0;
    for (const int c : candidates) live_count += world.target[c] > 0.0 ? 1 : 0;
    double mis_weight = 1.0 / CANDIDATE_COUNT;
    if (bug == Bug::FORGET_ONE_OVER_M) mis_weight = 1.0;
    if (bug == Bug::COUNT_LIVE_CANDIDATES_ONLY) mis_weight = live_count > 0 ? 1.0 / live_count : 0.0;
    Stream stream;
    for (int i = 0; i < CANDIDATE_COUNT; ++i) {
        const int c = candidates[i];
        const double pdf = bug == Bug::FORGET_ONE_OVER_PDF ? 1.0 : world.pdf[c];
        stream.offer(c, float(world.target[c]), float(mis_weight * world.target[c] / pdf), u[i]);
    }
    const Reservoir done = finish_reservoir(stream.live, float(CANDIDATE_COUNT));
    if (done.contribution_weight == 0.0f) return 0.0;
    return world.integrand[stream.chosen] * double(done.contribution_weight);
}

// Expectation of integrand * W over all candidate sequences and random numbers, over the true sum, less 1.
double relative_bias(Bug bug) {
    const ToyWorld world;
    double truth = 0.0;
    for (const double f : world.integrand) truth += f;
    double expectation = 0.0;
    for (int a = 0; a < world.SIZE; ++a) {
        for (int b = 0; b < world.SIZE; ++b) {
            for (int c = 0; c < world.SIZE; ++c) {
                double mean = 0.0;
                for (int i = 0; i < SECOND_STEPS * THIRD_STEPS; ++i) {
                    const vec3 u(0.5f, (i / THIRD_STEPS + 0.5f) / SECOND_STEPS,
                                 (i % THIRD_STEPS + 0.5f) / THIRD_STEPS);
                    mean += resample(world, {a, b, c}, u, bug);
                }
                expectation +=
                    world.pdf[a] * world.pdf[b] * world.pdf[c] * mean / (SECOND_STEPS * THIRD_STEPS);
            }
        }
    }
    return expectation / truth - 1.0;
}

// Rounding of the weights in single precision.
constexpr double BIAS_TOLERANCE = 1e-6;

TEST(Reservoir, ExpectationOfTheIntegrandTimesWIsItsIntegralWithDeadCandidatesCounted) {
    EXPECT_NEAR(relative_bias(Bug::NONE), 0.0, BIAS_TOLERANCE);
}

TEST(Reservoir, NegativeControlForgettingOneOverMIsDetected) {
    EXPECT_NEAR(relative_bias(Bug::FORGET_ONE_OVER_M), 2.0, 3.0 * BIAS_TOLERANCE);
}

TEST(Reservoir, NegativeControlCountingLiveCandidatesOnlyIsDetected) {
    EXPECT_GT(relative_bias(Bug::COUNT_LIVE_CANDIDATES_ONLY), 1e4 * BIAS_TOLERANCE);
}

TEST(Reservoir, NegativeControlAWeightWithoutOneOverPdfIsDetected) {
    EXPECT_LT(relative_bias(Bug::FORGET_ONE_OVER_PDF), -1e4 * BIAS_TOLERANCE);
}

TEST(Reservoir, TheChoiceIsInProportionToTheWeights) {
    const float weights[] = {3.0f, 1.0f, 4.0f};
    std::array<int, 3> chosen{};
    constexpr int STEPS = 256;
    for (int i = 0; i < STEPS * STEPS; ++i) {
        const float u[] = {0.5f, (i / STEPS + 0.5f) / STEPS, (i % STEPS + 0.5f) / STEPS};
        Stream stream;
        for (int k = 0; k < 3; ++k) stream.offer(k, 1.0f, weights[k], u[k]);
        ++chosen[stream.chosen];
    }
    // Probabilities are multiples of 1/8, so that the grid of u meets them exactly.
    for (int k = 0; k < 3; ++k) EXPECT_EQ(chosen[k], int(weights[k] / 8.0f * STEPS * STEPS)) << k;
}

// ---- Edges
// --------------------------------------------------------------------------------------------------------

TEST(Reservoir, AnEmptyOneFinishesToNothing) {
    const Reservoir r = finish_reservoir(empty_live_reservoir(), 32.0f);
    EXPECT_EQ(r.contribution_weight, 0.0f);
    EXPECT_EQ(r.confidence, 32.0f) << "dead candidates were seen";
}

TEST(Reservoir, AWeightOfZeroIsPassedOverWithoutComplaint) {
    Stream stream;
    EXPECT_NE(OFFER_BAD, stream.offer(1, 0.0f, 0.0f, 0.0f));
    EXPECT_EQ(stream.chosen, INVALID_INDEX);
    EXPECT_NE(OFFER_BAD, stream.offer(2, 1.0f, 1.0f, 0.5f));
    EXPECT_NE(OFFER_BAD, stream.offer(3, 0.0f, 0.0f, 0.0f));
    EXPECT_EQ(stream.chosen, 2u);
    EXPECT_EQ(stream.live.weight_sum, 1.0f);
}

TEST(Reservoir, NanInfiniteAndNegativeWeightsAreReportedAndChangeNothing) {
    const float infinity = std::numeric_limits<float>::infinity();
    for (const float weight : {std::numeric_limits<float>::quiet_NaN(), infinity, -infinity, -1.0f}) {
        Stream stream;
        stream.offer(1, 2.0f, 3.0f, 0.5f);
        EXPECT_EQ(OFFER_BAD, stream.offer(9, 1.0f, weight, 0.0f)) << weight;
        EXPECT_EQ(stream.chosen, 1u);
        EXPECT_EQ(stream.live.target, 2.0f);
        EXPECT_EQ(stream.live.weight_sum, 3.0f);
    }
}

// Subnormal numbers: W would leave float's range, or a thread would flush them to 0.
TEST(Reservoir, WeightsAndTargetsBelowTheLeastNormalNumberAreNoLight) {
    Stream stream;
    EXPECT_NE(OFFER_BAD, stream.offer(1, 1.0f, 1e-39f, 0.0f));
    EXPECT_NE(OFFER_BAD, stream.offer(2, 1e-40f, 1.0f, 0.0f));
    EXPECT_EQ(stream.live.weight_sum, 0.0f);
    EXPECT_EQ(stream.chosen, INVALID_INDEX);
    EXPECT_NE(OFFER_BAD, stream.offer(3, 1e-30f, 2e-38f, 0.0f));
    EXPECT_FALSE(has_overflown(stream.live));
    EXPECT_GT(finish_reservoir(stream.live, 1.0f).contribution_weight, 0.0f);
}

TEST(Reservoir, TheFirstLiveCandidateIsTakenForEveryUAndEveryWeight) {
    for (const float u : {0.0f, 0.5f, 1.0f - 0x1p-24f}) {
        for (float weight = 1e-30f; weight < 1e30f; weight *= 7.3f) {
            Stream stream;
            stream.offer(0, 0.0f, 0.0f, u);
            stream.offer(5, 1.0f, weight, u);
            EXPECT_EQ(stream.chosen, 5u) << u << ", " << weight;
        }
    }
}

TEST(Reservoir, UOfZeroTakesEachLiveCandidateAndUNextToOneKeepsTheFirst) {
    Stream stream;
    for (int k = 0; k < 4; ++k) stream.offer(k, 1.0f, 0.001f, 0.0f);
    EXPECT_EQ(stream.chosen, 3u);
    stream = {};
    for (int k = 0; k < 4; ++k) stream.offer(k, 1.0f, 1.0f, 1.0f - 0x1p-24f);
    EXPECT_EQ(stream.chosen, 0u);
}

TEST(Reservoir, OneCandidateGivesOneOverItsPdf) {
    Stream stream;
    const float target = 3.0f;
    const float pdf = 0.125f;
    stream.offer(1, target, target / pdf, 0.7f);
    EXPECT_EQ(finish_reservoir(stream.live, 1.0f).contribution_weight, 8.0f);
}

TEST(Reservoir, ASumBeyondSinglePrecisionFinishesToNothing) {
    Stream stream;
    stream.offer(1, 1.0f, 3e38f, 0.5f);
    stream.offer(2, 1.0f, 3e38f, 0.5f);
    const Reservoir r = finish_reservoir(stream.live, 2.0f);
    EXPECT_EQ(r.contribution_weight, 0.0f);
    EXPECT_EQ(r.confidence, 2.0f) << "the candidates were looked at";
}

TEST(ReservoirRecord, RoundTripKeepsEveryBit) {
    const LightSample sample{123456u, vec2(0.25f, -0.5f)};
    const Reservoir r{7.5f, 32.0f, 0.5f, 0.75f, 3.0f};
    uvec4 rows[RESERVOIR_ROWS];
    pack_reservoir(r, pack_light_sample(sample), rows[0], rows[1]);
    const Reservoir back = unpack_reservoir(rows[0], rows[1]);
    const LightSample sample_back = unpack_light_sample(uvec3(rows[0]));
    EXPECT_EQ(sample_back.light, sample.light);
    EXPECT_EQ(sample_back.uv, sample.uv);
    EXPECT_EQ(back.contribution_weight, r.contribution_weight);
    EXPECT_EQ(back.confidence, r.confidence);
    EXPECT_EQ(back.target, r.target);
    EXPECT_EQ(back.visibility, r.visibility);
    EXPECT_EQ(back.age, r.age);
}

}  // namespace
}  // namespace tarn
