// Exposure found on the device against the rule over whole images, and how it follows; enlarging.
#include "passes/exposure.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/display.h"
#include "gpu/pass_context.h"
#include "passes/enlarge.h"
#include "support/draws.h"
#include "support/exposure_oracle.h"

namespace tarn {
namespace {

using namespace test;

constexpr glm::ivec2 SIZE_PX(64, 64);

std::vector<glm::vec4> draw_radiance(float centre_stops, float range_stops, std::uint32_t seed) {
    Draws draws(seed);
    std::vector<glm::vec4> texels(std::size_t(SIZE_PX.x) * SIZE_PX.y);
    for (glm::vec4& texel : texels) {
        const float level = std::exp2(centre_stops + range_stops * float(draws.uniform(-0.5, 0.5)));
        texel = {level, 0.7f * level, 0.4f * level, 1.0f};
    }
    return texels;
}

class ExposurePass : public testing::Test {
  protected:
    Exposure find(const std::vector<glm::vec4>& texels, const ExposureInput& input,
                  const std::optional<Previous<Exposure>>& previous = std::nullopt) {
        context_.recorder().begin();
        const Picture radiance = context_.write_picture("test/radiance", size_px_, GL_RGBA32F, texels);
        const Exposure exposure =
            find_exposure(context_.frame(size_px_, size_px_), radiance, input, previous);
        context_.recorder().end();
        return exposure;
    }
    static float read_ev(const Exposure& exposure) {
        const glm::uvec4 row = exposure->buffer().download<glm::uvec4>()[0];
        EXPECT_NEAR(std::log2(glm::uintBitsToFloat(row.x)), glm::uintBitsToFloat(row.y), 1e-4f);
        return glm::uintBitsToFloat(row.y);
    }

    Image to_image(const std::vector<glm::vec4>& texels) const {
        Image image(size_px_.x, size_px_.y, 3);
        for (std::size_t i = 0; i < texels.size(); ++i) {
            for (int c = 0; c < 3; ++c) image.values[3 * i + std::size_t(c)] = texels[i][c];
        }
        return image;
    }

    glm::ivec2 size_px_ = SIZE_PX;
    PassContext context_;
};

TEST_F(ExposurePass, IsThatOfTheCpuAndOfSorting) {
    for (const float centre : {-25.0f, -5.0f, 0.0f, 9.0f}) {
        for (const float range : {0.0f, 4.0f, 20.0f}) {
            std::vector<glm::vec4> texels = draw_radiance(centre, range, 7);
            for (std::size_t i = 0; i < texels.size(); i += 5) texels[i] = glm::vec4(0.0f);
            const float infinite = std::numeric_limits<float>::infinity();
            texels[1] = glm::vec4(infinite);
            // Many enough that the rule of white would see them.
            for (std::size_t i = 2; i < texels.size(); i += 11)
                texels[i] = glm::vec4(std::numeric_limits<float>::quiet_NaN(), infinite, 1.0f, 1.0f);
            texels[3] = glm::vec4(-1.0f);
            const float ev = read_ev(find(texels, {}));
            EXPECT_NEAR(ev, auto_exposure_ev(to_image(texels)), 1e-3f) << centre << ", " << range;
            EXPECT_NEAR(ev, find_exposure_by_sorting(to_image(texels)), EXPOSURE_BIN_STOPS);
        }
    }
    EXPECT_EQ(read_ev(find(std::vector<glm::vec4>(64 * 64, glm::vec4(0.0f)), {})), 0.0f);
}

TEST_F(ExposurePass, KnowsWhiteAndLampsAsTheCpuDoes) {
    for (const std::size_t bright : {40u, 120u, 300u, 700u, 2000u}) {
        for (const float stops : {4.0f, 8.0f, 20.0f}) {
            std::vector<glm::vec4> texels = draw_radiance(0.0f, 3.0f, 1);
            for (std::size_t i = 0; i < bright; ++i) texels[2 * i] *= std::exp2(stops);
            const Image image = to_image(texels);
            const float ev = read_ev(find(texels, {}));
            EXPECT_NEAR(ev, auto_exposure_ev(image), 1e-3f) << bright << ", " << stops;
            EXPECT_NEAR(ev, find_exposure_by_sorting(image), EXPOSURE_BIN_STOPS) << bright << ", " << stops;
            ExposureInput clipping;
            clipping.tone = ToneCurve::CLIP;
            EXPECT_NEAR(read_ev(find(texels, clipping)), auto_exposure_ev(image, ToneCurve::CLIP), 1e-3f);
        }
    }
}

TEST_F(ExposurePass, OnePixelAndPicturesOfAnySize) {
    for (const glm::ivec2 size : {glm::ivec2(1, 1), glm::ivec2(3, 200), glm::ivec2(700, 500)}) {
        size_px_ = size;
        std::vector<glm::vec4> texels;
        for (int i = 0; i < size.x * size.y; ++i) texels.emplace_back(0.1f + float(i % 37));
        EXPECT_NEAR(read_ev(find(texels, {})), auto_exposure_ev(to_image(texels)), 1e-3f) << size.x;
    }
}

TEST_F(ExposurePass, FollowsInStopsAndGivesTheSameBits) {
    const std::vector<glm::vec4> dark = draw_radiance(-8.0f, 4.0f, 1);
    const std::vector<glm::vec4> bright = draw_radiance(0.0f, 4.0f, 2);
    History<Exposure> history;
    history.keep(1, find(dark, {}));
    const float from = read_ev(find(dark, {}));
    const float to = read_ev(find(bright, {}));
    ExposureInput input;
    input.elapsed_s = EXPOSURE_TIME_S;
    const float between = read_ev(find(bright, input, history.of_frame(1)));
    EXPECT_NEAR((between - from) / (to - from), 1.0 - std::exp(-1.0), 1e-4);
    EXPECT_EQ(between, read_ev(find(bright, input, history.of_frame(1))));
    input.fixed_ev = 3.0f;
    EXPECT_EQ(read_ev(find(bright, input, history.of_frame(1))), 3.0f);
}

class EnlargePass : public testing::Test {
  protected:
    std::vector<glm::vec4> run(const glm::ivec2& size_px, const glm::ivec2& output_px,
                               const std::vector<glm::vec4>& texels) {
        context_.recorder().begin();
        const Picture small = context_.write_picture("test/small", size_px, GL_RGBA32F, texels);
        const Picture large = enlarge(context_.frame(size_px, output_px), small);
        context_.recorder().end();
        return large->download<glm::vec4>();
    }

    PassContext context_;
};

TEST_F(EnlargePass, InterpolatesBetweenPixelCentresAndKeepsTheEdges) {
    const std::vector<glm::vec4> row = {glm::vec4(0.0f), glm::vec4(4.0f)};
    const std::vector<glm::vec4> wide = run({2, 1}, {4, 2}, row);
    const float expected[] = {0.0f, 1.0f, 3.0f, 4.0f};
    for (std::size_t i = 0; i < 8; ++i) EXPECT_EQ(wide[i].x, expected[i % 4]) << i;
    const std::vector<glm::vec4> column = run({1, 2}, {1, 4}, row);
    for (std::size_t i = 0; i < 4; ++i) EXPECT_EQ(column[i].y, expected[i]) << i;
    EXPECT_EQ(run({2, 1}, {2, 1}, row), row);
}

TEST_F(EnlargePass, KeepsRampsAndSizesThatDoNotDivide) {
    std::vector<glm::vec4> ramp;
    for (int y = 0; y < 7; ++y) {
        for (int x = 0; x < 5; ++x) ramp.emplace_back(float(x), float(y), float(x + y), 1.0f);
    }
    const std::vector<glm::vec4> large = run({5, 7}, {13, 17}, ramp);
    for (int y = 2; y < 15; ++y) {
        for (int x = 2; x < 11; ++x) {
            EXPECT_NEAR(large[std::size_t(13 * y + x)].x, (x + 0.5f) * 5.0f / 13.0f - 0.5f, 1e-5f);
            EXPECT_NEAR(large[std::size_t(13 * y + x)].y, (y + 0.5f) * 7.0f / 17.0f - 0.5f, 1e-5f);
        }
    }
}

}  // namespace
}  // namespace tarn
