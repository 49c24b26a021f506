// The mean of frames at rest and the error that is left, against sums in double precision.
#include "passes/average.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "gpu/pass_context.h"
#include "shared/math/average.h"
#include "support/draws.h"

namespace tarn {
namespace {

constexpr glm::ivec2 SIZE_PX(37, 21);
constexpr std::size_t PIXELS = 37 * 21;
using Texels = std::vector<glm::vec4>;

Texels draw_noise(test::Draws& draws) {
    Texels texels;
    for (std::size_t i = 0; i < PIXELS; ++i) {
        const float level = float(1 + i % 7) * float(draws.uniform(0.0, 2.0));
        texels.push_back({level, 0.5f * level, 2.0f * level, 1.0f});
    }
    return texels;
}

class AveragePass : public testing::Test {
  protected:
    // Frame by frame, as the renderer does.
    AveragedPicture run(const std::vector<Texels>& frames, const Texels* before = nullptr) {
        AveragedPicture result;
        History<AveragedFrames> history;
        History<Picture> shown;
        for (std::uint32_t number = 1; number <= frames.size(); ++number) {
            context_.recorder().begin();
            if (before != nullptr && number == 1) {
                shown.keep(0, context_.write_picture("test/before", SIZE_PX, GL_RGBA32F, *before));
            }
            const Picture radiance =
                context_.write_picture("test/radiance", SIZE_PX, GL_RGBA32F, frames[number - 1]);
            result = average_frames(context_.frame(SIZE_PX, SIZE_PX), radiance, history.of_frame(number - 1),
                                    shown.of_frame(number - 1));
            history.keep(number, result.averaged);
            context_.recorder().end();
        }
        return result;
    }

    test::PassContext context_;
};

TEST_F(AveragePass, IsTheMeanAndKnowsItsError) {
    test::Draws draws(4);
    std::vector<Texels> frames;
    for (int i = 0; i < 24; ++i) frames.push_back(draw_noise(draws));
    const AveragedPicture average = run(frames);
    const Texels shown = average.shown->download<glm::vec4>();
    double variance_sum = 0.0, light_sum = 0.0;
    for (std::size_t p = 0; p < PIXELS; ++p) {
        double sum = 0.0, squares = 0.0;
        for (const Texels& frame : frames) {
            const double light = 0.2126 * frame[p].x + 0.7152 * frame[p].y + 0.0722 * frame[p].z;
            sum += light, squares += light * light;
        }
        variance_sum += (squares - sum * sum / 24.0) / (24.0 * 23.0);
        light_sum += sum / 24.0;
        const double expected = light_sum == 0.0 ? 0.0 : sum / 24.0 / (0.2126 + 0.3576 + 0.1444);
        EXPECT_NEAR(shown[p].x, expected, 1e-4 * expected) << p;
    }
    const double error = find_relative_error(average.sums);
    EXPECT_NEAR(error, std::sqrt(variance_sum * PIXELS) / light_sum, 1e-4 * error);
    EXPECT_EQ(average.averaged.frames, 24u);
}

// As many frames again halve the square of the error.
TEST_F(AveragePass, TheErrorFallsWithTheRootOfTheFrames) {
    test::Draws draws(5);
    std::vector<Texels> frames;
    for (int i = 0; i < 40; ++i) frames.push_back(draw_noise(draws));
    const double all = find_relative_error(run(frames).sums);
    frames.resize(10);
    EXPECT_NEAR(find_relative_error(run(frames).sums) / all, 2.0, 0.15);
    frames.resize(1);
    EXPECT_EQ(find_relative_error(run(frames).sums), 0.0);
}

TEST_F(AveragePass, FadesFromThePictureBeforeToTheMean) {
    const Texels grey(PIXELS, glm::vec4(1.0f)), white(PIXELS, glm::vec4(3.0f));
    EXPECT_EQ(run({white}, &grey).shown->download<glm::vec4>()[5].x, 1.0f);
    const float between = run(std::vector<Texels>(26, white), &grey).shown->download<glm::vec4>()[5].x;
    EXPECT_NEAR(between, 1.0f + 2.0f * share_of_mean(26u), 1e-5f);
    EXPECT_GT(between, 1.5f);
    EXPECT_EQ(run(std::vector<Texels>(48, white), &grey).shown->download<glm::vec4>()[5].x, 3.0f);
    EXPECT_EQ(run({white}).shown->download<glm::vec4>()[5].x, 3.0f);
}

TEST_F(AveragePass, WhatIsNoNumberLeavesNoTrace) {
    Texels good(PIXELS, glm::vec4(2.0f)), bad = good;
    bad[7] = glm::vec4(std::numeric_limits<float>::quiet_NaN());
    bad[8] = glm::vec4(std::numeric_limits<float>::infinity());
    const AveragedPicture average = run({good, bad, good});
    for (const glm::vec4& texel : average.shown->download<glm::vec4>()) EXPECT_EQ(texel.x, 2.0f);
    EXPECT_EQ(find_relative_error(average.sums), 0.0);
}

}  // namespace
}  // namespace tarn
