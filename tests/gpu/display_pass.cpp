// The display pass on the GPU against the same transform over images on the CPU, and its views.
#include "passes/display.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/display.h"
#include "core/error.h"
#include "platform/context.h"
#include "shared/dialect.h"

namespace tarn {
namespace {

constexpr int WIDTH = 13;
constexpr int HEIGHT = 9;

// Colours from black to far beyond white, and what must not reach a screen.
std::vector<glm::vec4> make_radiance() {
    std::vector<glm::vec4> texels;
    for (int i = 0; i < WIDTH * HEIGHT; ++i) {
        const float level = std::exp2(float(i) * 0.15f - 10.0f);
        texels.push_back({level, level * 0.5f, level * float(i % 3), 1.0f});
    }
    texels[5] = {-1.0f, 0.5f, std::numeric_limits<float>::infinity(), 1.0f};
    return texels;
}

class DisplayPassTest : public testing::Test {
  protected:
    DisplayPassTest() : context_(create_context({})) {
        for (Texture2D& layer : surfaces_->layers) layer.clear(glm::vec4(0.0f));
        seen_->clear(glm::uvec4(INVALID_INDEX));
        radiance_.upload(make_radiance());
    }

    std::vector<glm::u8vec4> show(DisplayView view, float exposure_ev) {
        const GBuffer gbuffer{seen_, surfaces_, std::nullopt};
        frame_.begin();
        const Texture2D& picture = pass_.record(frame_, radiance_, gbuffer, view, exposure_ev);
        frame_.end();
        return picture.download<glm::u8vec4>();
    }

    Texture2D& layer(int index) { return surfaces_->layers[std::size_t(index)]; }

    std::unique_ptr<Context> context_;
    Texture2D radiance_{"test/radiance", WIDTH, HEIGHT, GL_RGBA32F};
    Picture seen_ = std::make_shared<Texture2D>("test/seen", WIDTH, HEIGHT, GL_RG32UI);
    Surfaces surfaces_ = std::make_shared<SurfaceImages>(glm::ivec2(WIDTH, HEIGHT));
    ProgramLibrary programs_;
    FrameRecorder frame_;
    DisplayPass pass_{programs_, WIDTH, HEIGHT};
};

TEST_F(DisplayPassTest, TheWindowShowsWhatThePngHolds) {
    Image image(WIDTH, HEIGHT, 3);
    const std::vector<glm::vec4> texels = make_radiance();
    for (std::size_t i = 0; i < texels.size(); ++i) {
        for (int c = 0; c < 3; ++c) image.values[3 * i + c] = texels[i][c];
    }
    for (const float exposure_ev : {-3.0f, 0.0f, 2.5f}) {
        const Image expected = display_from_radiance(image, exposure_ev);
        const std::vector<glm::u8vec4> shown = show(DisplayView::RADIANCE, exposure_ev);
        for (std::size_t i = 0; i < shown.size(); ++i) {
            for (int c = 0; c < 3; ++c) {
                // Half a step of 1/255 from rounding, a little for pow.
                EXPECT_NEAR(float(shown[i][c]), 255.0f * expected.values[3 * i + c], 0.6f) << "pixel " << i;
            }
        }
    }
}

TEST_F(DisplayPassTest, EveryViewCompilesAndKnowsEmptyPixels) {
    for (std::size_t i = 0; i < display_views().size(); ++i) {
        const DisplayView view = DisplayView(i);
        const bool shows_radiance = view == DisplayView::RADIANCE || view == DisplayView::LUMINANCE;
        const glm::u8vec4 first = show(view, 0.0f)[WIDTH * HEIGHT - 1];
        const bool black = first.x == 0 && first.y == 0 && first.z == 0;
        EXPECT_EQ(black, !shows_radiance) << display_views()[i].name;
        EXPECT_EQ(parse_display_view(display_views()[i].name), view);
    }
    EXPECT_THROW(parse_display_view("beauty"), Error);
}

TEST_F(DisplayPassTest, LuminanceIsGreenAtMiddleGrey) {
    radiance_.clear(glm::vec4(0.18f, 0.18f, 0.18f, 1.0f));
    EXPECT_NEAR(float(show(DisplayView::LUMINANCE, 0.0f)[0].y), 255.0f, 1.0f);
    EXPECT_NEAR(float(show(DisplayView::LUMINANCE, 0.0f)[0].x), 0.0f, 1.0f);
    const glm::u8vec4 bright = show(DisplayView::LUMINANCE, 8.0f)[0];
    EXPECT_EQ(int(bright.x) + bright.y + bright.z, 3 * 255);
}

TEST_F(DisplayPassTest, NormalsPointIntoTheirColours) {
    seen_->clear(glm::uvec4(1, 2, 0, 0));
    layer(LAYER_NORMALS).clear(glm::vec4(1.0f, 0.0f, 0.0f, 1.0f));  // octahedral: geometric +X, shading +Y
    EXPECT_EQ(show(DisplayView::GEOMETRIC_NORMALS, 0.0f)[0].x, 255);
    EXPECT_EQ(show(DisplayView::SHADING_NORMALS, 0.0f)[0].y, 255);
}

}  // namespace
}  // namespace tarn
