// The mean of many seeds of each mode of direct light equals the reference: per-tile test with Sidak correction.
// And three classic mistakes, planted one at a time, are found by the same test.
#include <gtest/gtest.h>

#include <cstdio>

#include "core/tile_test.h"
#include "platform/context.h"
#include "reference/reference.h"
#include "renderer/renderer.h"
#include "support/test_scenes.h"

namespace tarn::test {
namespace {

// Small pictures: the statistics need seeds, not pixels.
constexpr int WIDTH_PX = 96;
constexpr int HEIGHT_PX = 54;
constexpr int TILE_PX = 16;
constexpr int SEEDS = 256;
constexpr int SEEDS_TO_FIND_A_BUG = 64;
constexpr double SIGNIFICANCE = 0.01;

std::filesystem::path file_of(const std::string& name) {
    if (name == "VeachMIS") return shared_file("VeachMIS/veach_mis.gltf");
    if (name == "CyberpunkManyLights") return shared_file("CyberpunkManyLights/cyberpunk.gltf");
    return content_file(name);
}

class DirectLight : public testing::TestWithParam<const char*> {
  protected:
    static void SetUpTestSuite() { context_ = create_context({}); }
    static void TearDownTestSuite() { context_.reset(); }

    void SetUp() override {
        const std::filesystem::path file = file_of(GetParam());
        if (!std::filesystem::exists(file)) GTEST_SKIP() << file.string() << " is not here";
        scene_ = load_test_scene(file);
        camera_ = first_camera(*scene_, double(WIDTH_PX) / HEIGHT_PX);
        ReferenceSettings settings;
        settings.width = WIDTH_PX;
        settings.height = HEIGHT_PX;
        settings.camera = camera_;
        settings.direct_only = true;
        settings.spp = 4096;
        settings.seed = 7;
        const ReferenceResult reference = render_reference(scene_->world, *scene_->tracer, settings);
        EXPECT_EQ(reference.non_finite, 0u);
        reference_ = {reference.radiance, reference.variance};
    }

    TileTest run(DirectMode mode, int seeds, const std::vector<std::string>& planted = {}) {
        Renderer renderer(scene_->world, *scene_->tracer, WIDTH_PX, HEIGHT_PX, planted);
        FrameInput input;
        input.camera = camera_;
        input.settings.direct = mode;
        TileSamples samples(WIDTH_PX, HEIGHT_PX, TILE_PX);
        for (int seed = 0; seed < seeds; ++seed) {
            input.seed = std::uint32_t(seed) + 1000u;
            samples.add(renderer.read_radiance(renderer.render(input).radiance));
        }
        for (const auto& [name, value] : renderer.read_counters()) EXPECT_EQ(value, 0u) << name;
        const TileTest test = samples.test(reference_, SIGNIFICANCE);
        std::printf("%s: smallest p %.3g, threshold %.3g; worst tile at (%d, %d), %d px: %.6g against %.6g\n", GetParam(),
                    test.min_p_value, test.threshold, test.x, test.y, test.size_px, test.mean, test.reference_mean);
        return test;
    }

    static inline std::unique_ptr<Context> context_;
    std::unique_ptr<TestScene> scene_;
    CameraRecord camera_{};
    TileReference reference_;
};

TEST_P(DirectLight, UniformHasTheReferencesMean) { EXPECT_TRUE(run(DirectMode::UNIFORM, SEEDS).passes); }

TEST_P(DirectLight, RisHasTheReferencesMean) { EXPECT_TRUE(run(DirectMode::RIS, SEEDS).passes); }

TEST_P(DirectLight, PlantedBugsAreFound) {
    for (const char* bug : {"TARN_PLANT_DROP_PDF", "TARN_PLANT_DROP_COSINE", "TARN_PLANT_SHIFT_LIGHT"}) {
        EXPECT_FALSE(run(DirectMode::RIS, SEEDS_TO_FIND_A_BUG, {bug}).passes) << bug;
    }
}

INSTANTIATE_TEST_SUITE_P(Scenes, DirectLight,
                         testing::Values("cornell", "lantern_court", "VeachMIS", "CyberpunkManyLights"),
                         [](const auto& info) { return std::string(info.param); });

}  // namespace
}  // namespace tarn::test
