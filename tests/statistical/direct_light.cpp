// The mean of many seeds of each mode of direct light equals the reference: per-tile test with Sidak
// correction. And three classic mistakes, planted one at a time, are found by the same test.
#include "direct_light_case.h"

namespace tarn::test {
namespace {

constexpr int SEEDS = 256;
// Frames averaged into each seed's image. Glossy highlights and distant lanterns are rare bright events: over
// single frames 256 seeds meet some of them too seldom for the test's correction for skewness.
constexpr int FRAMES = 4;
constexpr int SEEDS_TO_FIND_A_BUG = 32;

class DirectLight : public DirectLightTest {
  protected:
    void SetUp() override { prepare(double(RenderSettings{}.direct.candidates) * FRAMES * SEEDS); }

    static bool is_large() { return case_->scene().world.lights.count > 1000; }

    static Image render_mean(Renderer& renderer, FrameInput input) {
        Image mean(WIDTH_PX, HEIGHT_PX, 3);
        for (int frame = 0; frame < FRAMES; ++frame) {
            input.frame = std::uint32_t(frame);
            const Image image = renderer.read_radiance(renderer.render(input).radiance);
            for (std::size_t i = 0; i < mean.values.size(); ++i)
                mean.values[i] += image.values[i] / float(FRAMES);
        }
        return mean;
    }

    TileTest run(DirectMode mode, int seeds, const std::vector<std::string>& planted = {},
                 bool brdf_candidate = false) {
        TestScene& scene = case_->scene();
        Renderer renderer(scene.world, *scene.tracer, WIDTH_PX, HEIGHT_PX, planted);
        FrameInput input;
        input.camera = case_->camera();
        input.settings.direct.mode = mode;
        input.settings.direct.brdf_candidate = brdf_candidate;
        TileSamples samples(WIDTH_PX, HEIGHT_PX, DirectLightCase::tile_px(GetParam()));
        for (int seed = 0; seed < seeds; ++seed) {
            input.seed = std::uint32_t(seed) + 1000u;
            Image image = render_mean(renderer, input);
            case_->clear_left_out(image);
            samples.add(image);
            if (!planted.empty() && case_->stands_out(samples)) break;
        }
        for (const auto& [name, value] : renderer.read_counters()) EXPECT_EQ(value, 0u) << name;
        return case_->test(samples, planted.empty() ? "unbroken" : planted.front());
    }
};

// At most half of the tests may fall back on blocks of tiles, or a mistake in one corner could hide in the
// mean of its surroundings.
constexpr double MAX_POOLED = 0.5;

TEST_P(DirectLight, RisHasTheReferencesMean) {
    const TileTest test = run(DirectMode::RIS, SEEDS);
    EXPECT_TRUE(test.passes);
    EXPECT_LE(test.pooled_fraction, MAX_POOLED);
}

// One light drawn of thousands is one that matters to the tile so seldom that all of the picture is pooled.
// There the means of large blocks are tested, and must be precise: a planted mistake moves them by 5 % and
// more.
TEST_P(DirectLight, UniformHasTheReferencesMean) {
    const TileTest test = run(DirectMode::UNIFORM, SEEDS);
    EXPECT_TRUE(test.passes);
    const bool has_thousands = case_->scene().world.lights.count > 1000;
    EXPECT_LE(test.pooled_fraction, has_thousands ? 1.0 : MAX_POOLED);
    if (has_thousands) {
        EXPECT_LT(test.standard_error, 0.02 * test.reference_mean);
    }
}

TEST_P(DirectLight, PlantedBugsAreFound) {
    for (const char* bug : {"TARN_PLANT_DROP_PDF", "TARN_PLANT_DROP_COSINE", "TARN_PLANT_SHIFT_LIGHT"}) {
        // The two lights of the Cornell box are the halves of one quad: to take one for the other changes
        // nothing.
        const bool harmless =
            bug == std::string("TARN_PLANT_SHIFT_LIGHT") && GetParam() == std::string("cornell");
        if (harmless) continue;
        for (const DirectMode mode : {DirectMode::UNIFORM, DirectMode::RIS}) {
            if (mode == DirectMode::UNIFORM && is_large()) continue;  // for time; they were found there too
            EXPECT_FALSE(run(mode, SEEDS_TO_FIND_A_BUG, {bug}).passes) << bug << int(mode);
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Scenes, DirectLight,
                         testing::Values("cornell", "lantern_court", "VeachMIS", "CyberpunkManyLights"),
                         [](const auto& info) { return std::string(info.param); });

class DirectLightBrdf : public DirectLight {};

// The candidate along the BRDF and those of the lights share each sample by their densities.
TEST_P(DirectLightBrdf, RisWithABrdfCandidateHasTheReferencesMean) {
    EXPECT_TRUE(run(DirectMode::RIS, SEEDS / 4, {}, true).passes);
}

TEST_P(DirectLightBrdf, ABrdfCandidateThatForgetsTheLightsDensityIsFound) {
    EXPECT_FALSE(run(DirectMode::RIS, SEEDS_TO_FIND_A_BUG, {"TARN_PLANT_FORGET_LIGHT_PDF"}, true).passes);
}

INSTANTIATE_TEST_SUITE_P(Scenes, DirectLightBrdf, testing::Values("cornell", "VeachMIS"),
                         [](const auto& info) { return std::string(info.param); });

}  // namespace
}  // namespace tarn::test
