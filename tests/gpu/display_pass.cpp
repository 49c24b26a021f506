// The display pass on the GPU against the same transform over images on the CPU, and its views.
#include "passes/display.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/display.h"
#include "core/error.h"
#include "gpu/pass_context.h"
#include "shared/dialect.h"

namespace tarn {
namespace {

constexpr glm::ivec2 SIZE_PX(53, 37);  // three levels of glare, all of odd sizes
constexpr std::size_t PIXELS = 53 * 37;

// Colours from black to far beyond white, and what must not reach a screen.
std::vector<glm::vec4> make_radiance() {
    std::vector<glm::vec4> texels;
    for (std::size_t i = 0; i < PIXELS; ++i) {
        const float level = std::exp2(float(i) * (17.5f / float(PIXELS)) - 10.0f);
        texels.push_back({level, level * 0.5f, level * float(i % 3), 1.0f});
    }
    texels[5] = {-1.0f, 0.5f, std::numeric_limits<float>::infinity(), 1.0f};
    return texels;
}

class DisplayPassTest : public testing::Test {
  protected:
    std::vector<glm::u8vec4> show(DisplayView view, float exposure_ev, const DisplayLook& look = {}) {
        context_.recorder().begin();
        const FrameContext frame = context_.frame(SIZE_PX, SIZE_PX);
        const Picture seen = context_.write_picture("test/seen", SIZE_PX, GL_RG32UI, seen_);
        const Picture radiance = context_.write_picture("test/radiance", SIZE_PX, GL_RGBA32F, radiance_);
        frame.pass("test/surfaces").write_image(0, surfaces_->texels());
        const Exposure exposure = find_exposure(frame, radiance, {exposure_ev}, std::nullopt);
        const GBuffer gbuffer{seen, surfaces_, std::nullopt};
        const Picture picture = show_frame(frame, {view, look}, radiance, gbuffer, exposure);
        context_.recorder().end();
        return picture->download<glm::u8vec4>();
    }

    static void expect_same(const std::vector<glm::u8vec4>& shown, const Image& expected) {
        for (std::size_t i = 0; i < shown.size(); ++i) {
            for (int c = 0; c < 3; ++c) {
                // Half a step of 1/255 from rounding, a little for pow.
                EXPECT_NEAR(float(shown[i][c]), 255.0f * expected.values[3 * i + c], 0.6f) << "pixel " << i;
            }
        }
    }

    test::PassContext context_;
    std::vector<glm::vec4> radiance_ = make_radiance();
    std::vector<glm::uvec2> seen_ = std::vector<glm::uvec2>(PIXELS, glm::uvec2(INVALID_INDEX));
    Surfaces surfaces_ = std::make_shared<SurfaceTable>(SIZE_PX, BufferUse::DYNAMIC);
};

TEST_F(DisplayPassTest, TheWindowShowsWhatThePngHolds) {
    Image image(SIZE_PX.x, SIZE_PX.y, 3);
    for (std::size_t i = 0; i < PIXELS; ++i) {
        for (int c = 0; c < 3; ++c) image.values[3 * i + c] = radiance_[i][c];
    }
    for (const float exposure_ev : {-3.0f, 0.0f, 2.5f}) {
        for (const ToneCurve tone : {ToneCurve::CLIP, ToneCurve::NEUTRAL}) {
            for (const float glare : {0.0f, 1.0f, 8.0f}) {
                const DisplayLook look{tone, glare};
                expect_same(show(DisplayView::RADIANCE, exposure_ev, look),
                            display_from_radiance(image, exposure_ev, look));
            }
        }
    }
}

TEST_F(DisplayPassTest, EveryViewCompilesAndKnowsEmptyPixels) {
    for (std::size_t i = 0; i < display_views().size(); ++i) {
        const DisplayView view = DisplayView(i);
        const bool shows_radiance = view == DisplayView::RADIANCE || view == DisplayView::LUMINANCE;
        const glm::u8vec4 first = show(view, 0.0f)[PIXELS - 1];
        const bool black = first.x == 0 && first.y == 0 && first.z == 0;
        EXPECT_EQ(black, !shows_radiance) << display_views()[i].name;
        EXPECT_EQ(parse_display_view(display_views()[i].name), view);
    }
    EXPECT_THROW(parse_display_view("beauty"), Error);
}

TEST_F(DisplayPassTest, LuminanceIsGreenAtMiddleGrey) {
    radiance_.assign(PIXELS, glm::vec4(0.18f, 0.18f, 0.18f, 1.0f));
    EXPECT_NEAR(float(show(DisplayView::LUMINANCE, 0.0f)[0].y), 255.0f, 1.0f);
    EXPECT_NEAR(float(show(DisplayView::LUMINANCE, 0.0f)[0].x), 0.0f, 1.0f);
    const glm::u8vec4 bright = show(DisplayView::LUMINANCE, 8.0f)[0];
    EXPECT_EQ(int(bright.x) + bright.y + bright.z, 3 * 255);
}

TEST_F(DisplayPassTest, NormalsPointIntoTheirColours) {
    seen_.assign(PIXELS, glm::uvec2(1, 2));
    // Octahedral: geometric +X, shading +Y.
    surfaces_->upload(LAYER_NORMALS, std::vector<glm::vec4>(PIXELS, {1.0f, 0.0f, 0.0f, 1.0f}));
    EXPECT_EQ(show(DisplayView::GEOMETRIC_NORMALS, 0.0f)[0].x, 255);
    EXPECT_EQ(show(DisplayView::SHADING_NORMALS, 0.0f)[0].y, 255);
}

}  // namespace
}  // namespace tarn
