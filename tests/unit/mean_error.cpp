// The error left in a mean, from batches of frames, against what it is.
#include "metrics/mean_error.h"

#include <gtest/gtest.h>

#include <cmath>

#include "support/draws.h"

namespace tarn {
namespace {

// Frames of mean 1 and deviation 1 / sqrt(12); with `memory` each is mostly the last one.
double measure(int frames, int batch_frames, double memory, double* truth = nullptr) {
    test::Draws draws(11);
    MeanError error(batch_frames);
    const int pixels = 400;
    std::vector<double> state(pixels, 1.0), sum(pixels);
    for (int frame = 0; frame < frames; ++frame) {
        Image image(20, 20, 3);
        for (int p = 0; p < pixels; ++p) {
            state[p] = memory * state[p] + (1.0 - memory) * draws.uniform(0.5, 1.5);
            sum[p] += state[p];
            for (int c = 0; c < 3; ++c) image.values[std::size_t(3 * p + c)] = float(state[p]);
        }
        error.add(image);
    }
    if (truth != nullptr) {
        double squares = 0.0;
        for (const double s : sum) squares += (s / frames - 1.0) * (s / frames - 1.0);
        *truth = std::sqrt(squares / pixels);
    }
    return error.relative_error().value_or(-1.0);
}

TEST(MeanError, isTheErrorOfIndependentFrames) {
    double truth = 0.0;
    const double error = measure(64, 1, 0.0, &truth);
    EXPECT_NEAR(error, std::sqrt(1.0 / 12.0 / 64.0), 0.03 * error);
    EXPECT_NEAR(error, truth, 0.15 * error);
}

// Frames that share history look better than they are, unless batches are long beside what they remember.
TEST(MeanError, ofFramesThatRememberNeedsLongBatches) {
    double truth = 0.0;
    const double alone = measure(640, 1, 0.9, &truth), batched = measure(640, 64, 0.9);
    EXPECT_LT(alone, 0.5 * truth);
    EXPECT_NEAR(batched, truth, 0.25 * truth);
}

TEST(MeanError, isUnknownForLessThanTwoBatches) {
    EXPECT_EQ(measure(1, 1, 0.0), -1.0);
    EXPECT_EQ(measure(63, 32, 0.0), -1.0);
    EXPECT_GT(measure(64, 32, 0.0), 0.0);
}

}  // namespace
}  // namespace tarn
