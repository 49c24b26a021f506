// Steps whose answers are known: at once, as an exponential mean of the past, never.
#include "metrics/step_response.h"

#include <gtest/gtest.h>

#include <cmath>

#include "support/draws.h"

namespace tarn {
namespace {

constexpr int SIDE_PX = 24;
constexpr int FRAMES = 64;
constexpr int SEEDS = 4;

// A picture at `share` of the way between two worlds, with noise of the given deviation.
Image make_picture(double share, double deviation, test::Draws& draws) {
    Image image(SIDE_PX, SIDE_PX, 3);
    for (std::size_t i = 0; i < image.values.size(); ++i) {
        const double before = 1.0 + double(i % 5), after = 2.0 + double(i % 7);
        const double noise = deviation * std::sqrt(12.0) * (draws.uniform() - 0.5);
        image.values[i] = float(before + share * (after - before) + noise);
    }
    return image;
}

// What a method shows that follows as `share(frame)` says, frame 1 being the first, with `deviation(frame)`.
template <class Share, class Deviation>
StepResponse follow(const Share& share, const Deviation& deviation) {
    test::Draws draws(1);
    StepResponse response(FRAMES);
    for (int seed = 0; seed < SEEDS; ++seed) {
        for (int i = 0; i < 8; ++i) response.add_before(make_picture(0.0, 0.3, draws));
        for (int i = 0; i < FRAMES; ++i) {
            response.add_after(i, make_picture(share(i + 1), deviation(i + 1), draws));
        }
    }
    return response;
}

const auto even = [](int) { return 0.3; };

TEST(StepResponse, AtOnceIsTheFirstFrame) {
    const StepResponse response = follow([](int) { return 1.0; }, even);
    EXPECT_EQ(response.frames_to_reach(0.9), 1);
    EXPECT_EQ(response.frames_to_settle(1.1), 1);
}

// 1 - 0.8^n passes 0.9 with n = 11.
TEST(StepResponse, AnExponentialMeanLagsAsItsWeightSays) {
    const StepResponse response = follow([](int n) { return 1.0 - std::pow(0.8, n); }, even);
    EXPECT_EQ(response.frames_to_reach(0.9), 11);
    EXPECT_NEAR(response.progress()[4], 1.0 - std::pow(0.8, 5), 0.02);
    EXPECT_NEAR(response.progress()[0], 0.2, 0.02);
}

// A variance of 0.09 (1 + 9 / n^2) is within a tenth of 0.09 from n = 10 on; the noise of the end adds a
// little.
TEST(StepResponse, NoiseThatDiesDownSettlesWhenItHas) {
    const StepResponse response =
        follow([](int) { return 1.0; }, [](int n) { return 0.3 * std::sqrt(1.0 + 9.0 / (n * n)); });
    EXPECT_EQ(response.frames_to_reach(0.9), 1);
    const auto settled = response.frames_to_settle(1.1);
    ASSERT_TRUE(settled);
    EXPECT_NEAR(*settled, 10, 2);
    EXPECT_NEAR(response.noise()[0], 0.9, 0.05);
}

TEST(StepResponse, ALateStepIsSeenLate) {
    const StepResponse response = follow([](int n) { return n < 20 ? 0.0 : 1.0; }, even);
    EXPECT_EQ(response.frames_to_reach(0.9), 20);
}

}  // namespace
}  // namespace tarn
