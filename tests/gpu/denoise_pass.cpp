// The denoiser's passes: what they must leave alone, what must leave no trace, and that mistakes are found.
#include <gtest/gtest.h>

#include "gpu/denoise_stage.h"
#include "support/draws.h"

namespace tarn {
namespace {

using namespace test;

constexpr glm::ivec2 SIZE_PX(61, 43);  // no multiple of a group
constexpr DenoiseMode MODES[] = {DenoiseMode::SVGF_STATIC, DenoiseMode::BILATERAL};
constexpr DenoiseKernel KERNELS[] = {DenoiseKernel::CROSS, DenoiseKernel::BOX3, DenoiseKernel::BOX5};

// ---- Even light

// Of some frames, in which the camera moves by parts of pixels.
double error_of_even_light(DenoiseMode mode, DenoiseKernel kernel, int steps, const Defines& planted = {}) {
    DenoiseStage stage(SIZE_PX);
    stage.settings.denoise.mode = mode;
    stage.settings.denoise.kernel = kernel;
    stage.settings.denoise.steps = steps;
    stage.plant(planted);
    const glm::vec2 even(3.0f, 7.0f);
    double error = 0.0;
    for (int frame = 0; frame < 6; ++frame) {
        const Denoised found = stage.render(meet_room, [&](const glm::ivec2&, const Met&) { return even; });
        error = std::max(error, greatest_error(found, [&](const Met&) { return even; }));
        stage.move_camera({0.013f, 0.007f, -0.01f});
    }
    EXPECT_EQ(stage.count(COUNTER_BAD_LIGHT), 0u);
    return error;
}

TEST(DenoisePass, EvenLightStaysWhatItIsAtEdgesAndInMotion) {
    for (const DenoiseMode mode : MODES) {
        for (const DenoiseKernel kernel : KERNELS)
            EXPECT_LT(error_of_even_light(mode, kernel, 4), 1e-5) << int(mode) << " " << int(kernel);
        EXPECT_LT(error_of_even_light(mode, DenoiseKernel::BOX3, 1), 1e-5) << "one step";
    }
}

TEST(DenoisePass, WeightsThatAreNotDividedByTheirSumAreFound) {
    EXPECT_GT(error_of_even_light(DenoiseMode::SVGF_STATIC, DenoiseKernel::BOX3, 4,
                                  {"TARN_PLANT_DROP_FILTER_NORMALIZATION"}),
              0.1);
}

// ---- Surfaces

// Each thing has light of its own, without noise: what one shows of another's is a ghost or a leak.
double error_of_parallax(const Defines& planted) {
    DenoiseStage stage(SIZE_PX);
    stage.plant(planted);
    const auto light_of = [](const Met& met) { return glm::vec2(1.0f + 4.0f * float(met.thing)); };
    double error = 0.0;
    for (int frame = 0; frame < 10; ++frame) {
        const Denoised found =
            stage.render(meet_room, [&](const glm::ivec2&, const Met& met) { return light_of(met); });
        error = std::max(error, greatest_error(found, light_of));
        stage.move_camera({0.05f, 0.0f, 0.0f});
    }
    return error;
}

TEST(DenoisePass, WhatComesIntoViewShowsNoGhostOfWhatHidIt) {
    EXPECT_LT(error_of_parallax({}), 0.02);
}

TEST(DenoisePass, AHistoryThatIsNotAskedForItsGeometryIsFound) {
    EXPECT_GT(error_of_parallax({"TARN_PLANT_NO_GEOMETRY_TEST"}), 0.3);
}

TEST(DenoisePass, WhatIsNotLitStaysBlackAndLendsNothing) {
    DenoiseStage stage(SIZE_PX);
    const SceneOf horizon = [](const glm::vec3& origin, const glm::vec3& direction) {
        Met met = meet_wall(origin, direction);
        met.lit = direction.y < 0.05f;
        return met;
    };
    for (int frame = 0; frame < 3; ++frame) {
        const Denoised found = stage.render(
            horizon, [](const glm::ivec2&, const Met& met) { return glm::vec2(met.lit ? 1.0f : 100.0f); });
        for (std::size_t i = 0; i < found.light.size(); ++i)
            EXPECT_NEAR(found.light[i].x, found.met[i].lit ? 1.0f : 0.0f, 1e-5f) << i;
    }
}

// What a mirror shows changes from pixel to pixel, though the mirror is even: stripes that a rough layer
// would blur.
double error_of_stripes(float alpha, const Defines& planted = {}) {
    DenoiseStage stage(SIZE_PX);
    stage.alpha = alpha;
    stage.plant(planted);
    const auto stripe = [](int x) { return x % 4 < 2 ? 1.0f : 3.0f; };
    const Denoised found = stage.render(
        meet_wall, [&](const glm::ivec2& pixel, const Met&) { return glm::vec2(1.0f, stripe(pixel.x)); });
    double error = 0.0;
    for (std::size_t i = 0; i < found.light.size(); ++i) {
        const double wrong = double(found.light[i].y) - double(stripe(int(i) % SIZE_PX.x));
        error = std::max(error, std::abs(wrong));
    }
    return error;
}

TEST(DenoisePass, MirrorsKeepWhatTheyShow) {
    EXPECT_LT(error_of_stripes(0.002f), 1e-4);
    EXPECT_GT(error_of_stripes(0.5f), 0.1) << "a rough layer shows no stripes: they are noise";
}

TEST(DenoisePass, LobesThatAreTakenToBeWideAreFound) {
    EXPECT_GT(error_of_stripes(0.002f, {"TARN_PLANT_WIDE_LOBES"}), 0.1);
}

// ---- Noise

// One sample a pixel: 0 three times in four, 4 times the mean else.
float draw_noise(Draws& draws) {
    return draws.uniform(0.0, 1.0) < 0.25 ? 4.0f : 0.0f;
}

struct NoiseLeft {
    double mean = 0.0;
    double rms = 0.0;
};

// Of the last frame, over `scale`.
NoiseLeft measure_noise(DenoiseMode mode, int frames, float scale, const Defines& planted = {}) {
    DenoiseStage stage(SIZE_PX);
    stage.settings.denoise.mode = mode;
    stage.plant(planted);
    Draws draws(7);
    Denoised last;
    for (int frame = 0; frame < frames; ++frame) {
        last = stage.render(meet_wall, [&](const glm::ivec2&, const Met&) {
            const float value = draw_noise(draws);
            return scale * glm::vec2(value, draw_noise(draws));
        });
    }
    NoiseLeft left;
    for (const glm::vec2& light : last.light) {
        left.mean += double(light.x + light.y) / scale / 2.0;
        left.rms +=
            std::pow(double(light.x) / scale - 1.0, 2.0) + std::pow(double(light.y) / scale - 1.0, 2.0);
    }
    left.mean /= double(last.light.size());
    left.rms = std::sqrt(left.rms / double(2 * last.light.size()));
    return left;
}

// The noise itself has an RMS of 1.73.
TEST(DenoisePass, NoiseGoesAndTheEnergyStays) {
    for (const DenoiseMode mode : MODES) {
        const NoiseLeft first = measure_noise(mode, 1, 1.0f), last = measure_noise(mode, 24, 1.0f);
        EXPECT_NEAR(first.mean, 1.0, 0.03);  // of 5246 samples: 1.2 sigma
        EXPECT_LT(first.rms, 0.4);
        EXPECT_NEAR(last.mean, 1.0, 0.02);
        EXPECT_LT(last.rms, 0.1);
    }
}

TEST(DenoisePass, AVarianceThatIsDroppedIsFound) {
    const NoiseLeft healthy = measure_noise(DenoiseMode::SVGF_STATIC, 24, 1.0f);
    const NoiseLeft planted = measure_noise(DenoiseMode::SVGF_STATIC, 24, 1.0f, {"TARN_PLANT_DROP_VARIANCE"});
    EXPECT_GT(planted.rms, 3.0 * healthy.rms);
}

// Sums and squares of both fit: the picture at another exposure is the same picture.
TEST(DenoisePass, TwelveDecadesOfLightKeepTheirDigits) {
    const NoiseLeft one = measure_noise(DenoiseMode::SVGF_STATIC, 12, 1.0f);
    for (const float scale : {1e-6f, 1e6f}) {
        const NoiseLeft other = measure_noise(DenoiseMode::SVGF_STATIC, 12, scale);
        EXPECT_NEAR(other.mean, one.mean, 1e-4) << scale;
        EXPECT_NEAR(other.rms, one.rms, 1e-3) << scale;
    }
}

// Both in one frame, on one wall: neither loses its digits nor leaks. The edge of a shadow is no edge of
// geometry.
TEST(DenoisePass, BrightAndDarkLieSideBySide) {
    DenoiseStage stage(SIZE_PX);
    const auto light_of = [](const Met& met) { return glm::vec2(met.position.x < 0.0f ? 1e-6f : 1e6f); };
    for (int frame = 0; frame < 8; ++frame) {
        const Denoised found =
            stage.render(meet_wall, [&](const glm::ivec2&, const Met& met) { return light_of(met); });
        if (frame >= 4) {
            EXPECT_LT(greatest_error(found, light_of), 1e-3) << frame;
        }
    }
}

// ---- One bad pixel

struct Trace {
    double error = 0.0;  // after the frame of the bad pixel
    std::uint32_t counted = 0;
};

// `at_frame`: the first one, or one with a history.
Trace find_trace(float bad, int at_frame, const Defines& planted = {}) {
    DenoiseStage stage(SIZE_PX);
    stage.plant(planted);
    const auto even = [](const Met&) { return glm::vec2(1.0f); };
    Trace trace;
    for (int frame = 0; frame < at_frame + 4; ++frame) {
        const Denoised found = stage.render(meet_wall, [&](const glm::ivec2& pixel, const Met&) {
            const bool is_bad = frame == at_frame && pixel == glm::ivec2(30, 20);
            return glm::vec2(is_bad ? bad : 1.0f);
        });
        if (frame > at_frame) trace.error = std::max(trace.error, greatest_error(found, even));
    }
    trace.counted = stage.count(COUNTER_BAD_LIGHT);
    return trace;
}

TEST(DenoisePass, OneBadPixelLeavesNoTraceAfterItsFrameAndIsCounted) {
    for (const float bad : {std::nanf(""), INFINITY, 1e6f, -1.0f}) {
        for (const int at_frame : {0, 1, 8}) {
            const Trace trace = find_trace(bad, at_frame);
            EXPECT_LT(trace.error, 1e-5) << bad << " in frame " << at_frame;
            EXPECT_EQ(trace.counted, 1u) << bad << " in frame " << at_frame;
        }
    }
}

TEST(DenoisePass, AHistoryThatIsNotSanitizedIsFound) {
    EXPECT_GT(find_trace(std::nanf(""), 8, {"TARN_PLANT_UNSANITIZED"}).error, 1.0);
    EXPECT_GT(find_trace(1e6f, 8, {"TARN_PLANT_UNSANITIZED"}).error, 1.0);
}

// ---- Jitter

// A shadow's edge on a wall that the camera sees at rest, without noise: how far its picture after many
// frames is from what the pixels see in the mean, at most over the rows.
double error_of_shadow(int jitter_count, const Defines& planted = {}) {
    constexpr int FRAMES = 48;
    DenoiseStage stage(SIZE_PX);
    stage.settings.denoise.steps = 1;
    stage.jitter_count = jitter_count;
    stage.plant(planted);
    const auto light_of = [](const Met& met) { return glm::vec2(met.position.x > 0.3f ? 3.0f : 1.0f); };
    std::vector<double> seen(std::size_t(SIZE_PX.x * SIZE_PX.y), 0.0);
    Denoised found;
    for (int frame = 0; frame < FRAMES; ++frame) {
        found = stage.render(meet_wall, [&](const glm::ivec2&, const Met& met) { return light_of(met); });
        for (std::size_t i = 0; i < seen.size(); ++i) seen[i] += light_of(found.met[i]).x / FRAMES;
    }
    double sum = 0.0;
    for (std::size_t i = 0; i < seen.size(); ++i) sum += std::abs(double(found.light[i].x) - seen[i]);
    return sum / SIZE_PX.y;
}

TEST(DenoisePass, AtRestAHistoryWithJitterBlursNoShadow) {
    fmt::print("{} {} {}\n", error_of_shadow(1), error_of_shadow(16),
               error_of_shadow(16, {"TARN_PLANT_JITTERED_HISTORY"}));
    EXPECT_LT(error_of_shadow(16), 1.5);
}

TEST(DenoisePass, AHistoryThatIsInterpolatedAtTheJitterIsFound) {
    EXPECT_GT(error_of_shadow(16, {"TARN_PLANT_JITTERED_HISTORY"}), 1.5);
}

}  // namespace
}  // namespace tarn
