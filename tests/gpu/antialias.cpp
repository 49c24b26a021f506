// Antialiasing over time in a renderer: where it has a past, and that it keeps the energy of all that is
// drawn.
#include <gtest/gtest.h>

#include "passes/antialias/jitter.h"
#include "renderer/renderer.h"
#include "shared/math/colour.h"
#include "support/on_context.h"
#include "support/test_scenes.h"

namespace tarn::test {
namespace {

constexpr glm::ivec2 SIZE_PX(96, 54);

RenderSettings antialiased(RenderSettings settings, double scale = 1.0) {
    settings.antialias = {AntialiasMode::TAA, AntialiasMean::RADIANCE, scale};
    return settings;
}

class Antialias : public OnContext<> {
  protected:
    explicit Antialias(const char* scene = "cornell")
        : scene_(load_test_scene(content_file(scene))),
          renderer_(scene_->world, *scene_->tracer, SIZE_PX.x, SIZE_PX.y) {
        input_.camera = first_camera(*scene_, double(SIZE_PX.x) / SIZE_PX.y);
    }

    // The next frame; each texel with the count of its samples.
    std::vector<glm::vec4> render() {
        const FrameOutput output = renderer_.render(input_);
        ++input_.frame;
        EXPECT_EQ(glm::ivec2(output.radiance.width_px(), output.radiance.height_px()), SIZE_PX);
        return output.radiance.download<glm::vec4>();
    }
    // Samples behind a pixel of the next frame, on average.
    double count_samples() {
        double sum = 0.0;
        for (const glm::vec4& texel : render()) sum += texel.w;
        return sum / double(SIZE_PX.x * SIZE_PX.y);
    }

    std::unique_ptr<TestScene> scene_;
    Renderer renderer_;
    FrameInput input_;
};

TEST_F(Antialias, APictureOfOtherSettingsOrAfterACutIsNoPast) {
    input_.settings = antialiased({});
    for (int frame = 1; frame < 5; ++frame) EXPECT_NEAR(count_samples(), frame, 0.01);
    input_.settings.direct.candidates = 8;
    EXPECT_NEAR(count_samples(), 1.0, 0.01) << "other settings";
    EXPECT_NEAR(count_samples(), 2.0, 0.01);
    ++input_.frame;
    EXPECT_NEAR(count_samples(), 1.0, 0.01) << "a frame is missing";
    EXPECT_NEAR(count_samples(), 2.0, 0.01);
    renderer_.reset_history();
    EXPECT_NEAR(count_samples(), 1.0, 0.01) << "a cut";
    input_.camera.forward = -input_.camera.forward;
    input_.camera.right = -input_.camera.right;
    EXPECT_NEAR(count_samples(), 1.0, 0.01) << "another view";
}

TEST_F(Antialias, ThePastOutlivesAChangeOfScale) {
    input_.settings = antialiased({});
    for (int frame = 0; frame < 8; ++frame) render();
    input_.settings.antialias.scale = 0.5;
    EXPECT_GT(count_samples(), 7.9);
    input_.settings.antialias.scale = 1.0;
    EXPECT_GT(count_samples(), 8.9);
    EXPECT_EQ(renderer_.read_counters().at("bad_light"), 0u);
}

TEST_F(Antialias, DebugViewsAreShownAsTheyAre) {
    const auto show = [&](bool smooth) {
        input_.frame = 3;
        input_.settings = smooth ? antialiased({}) : RenderSettings();
        input_.settings.direct.debug_view = DebugView::SAMPLES;
        return render();
    };
    EXPECT_EQ(show(true), show(false));
}

class AntialiasedCourt : public Antialias {
  protected:
    AntialiasedCourt() : Antialias("lantern_court") {}
};

// The same samples, as their mean and as the picture over time: lamps a pixel wide, mirrors and all.
TEST_F(AntialiasedCourt, KeepsTheEnergyOfItsSamples) {
    constexpr int FRAMES = 16;
    const int places = plan_antialias(antialiased({})).jitter_count;
    for (const char* preset : {"fast", "clean"}) {
        RenderSettings settings = find_preset(preset).settings;
        settings.antialias = {};
        double expected = 0.0, found = 0.0;
        input_.settings = settings;
        for (input_.frame = 0; input_.frame < FRAMES;) {
            input_.jitter_px = find_jitter(input_.frame, places);
            for (const glm::vec4& texel : render()) expected += luminance(glm::vec3(texel)) / FRAMES;
        }
        renderer_.reset_history();
        input_.settings = antialiased(settings);
        input_.jitter_px = {};
        std::vector<glm::vec4> last;
        for (input_.frame = 0; input_.frame < FRAMES;) last = render();
        for (const glm::vec4& texel : last) found += luminance(glm::vec3(texel));
        fmt::print("{}: {:.4f} of the energy\n", preset, found / expected);
        EXPECT_NEAR(found / expected, 1.0, 0.01) << preset;
    }
}

}  // namespace
}  // namespace tarn::test
