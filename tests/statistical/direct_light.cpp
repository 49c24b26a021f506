// The mean of many seeds of each mode of direct light equals the reference: per-tile test with Sidak
// correction. And three classic mistakes, planted one at a time, are found by the same test.
#include <gtest/gtest.h>

#include <cstdio>

#include "core/tile_test.h"
#include "platform/context.h"
#include "reference/reference.h"
#include "renderer/renderer.h"
#include "shared/math/random.h"
#include "support/test_scenes.h"

namespace tarn::test {
namespace {

// Small pictures: the statistics need seeds, not pixels.
constexpr int WIDTH_PX = 96;
constexpr int HEIGHT_PX = 54;
constexpr int TILE_PX = 16;
constexpr int SEEDS = 256;
// Frames averaged into each seed's image. Glossy highlights and distant lanterns are rare bright events: over single
// frames 256 seeds meet some of them too seldom for the test's correction for skewness.
constexpr int FRAMES = 4;
constexpr int SEEDS_TO_FIND_A_BUG = 32;
constexpr double SIGNIFICANCE = 0.01;

std::filesystem::path file_of(const std::string& name) {
    if (name == "VeachMIS") return shared_file("VeachMIS/veach_mis.gltf");
    if (name == "CyberpunkManyLights") return shared_file("CyberpunkManyLights/cyberpunk.gltf");
    return content_file(name);
}

class DirectLight : public testing::TestWithParam<const char*> {
  protected:
    static void SetUpTestSuite() { context_ = create_context({}); }
    static void TearDownTestSuite() {
        scene_.reset();
        loaded_.clear();
        context_.reset();
    }

    void SetUp() override {
        const std::filesystem::path file = file_of(GetParam());
        if (!std::filesystem::exists(file)) GTEST_SKIP() << file.string() << " is not here";
        // All tests of a scene share its reference.
        if (loaded_ != GetParam()) prepare(file);
        loaded_ = GetParam();
    }

    static void prepare(const std::filesystem::path& file) {
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
        find_silhouettes();
        clear_silhouettes(reference_.mean);
        clear_silhouettes(reference_.variance);
    }

    static void find_silhouettes() {
        Renderer renderer(scene_->world, *scene_->tracer, WIDTH_PX, HEIGHT_PX);
        FrameInput input;
        input.camera = camera_;
        const auto seen = renderer.render(input).gbuffer.seen.download<glm::uvec2>();
        silhouettes_.clear();
        for (std::uint32_t pixel = 0; pixel < seen.size(); ++pixel) {
            const glm::vec2 centre(float(pixel % WIDTH_PX) + 0.5f, float(pixel / WIDTH_PX) + 0.5f);
            const PixelRay view = camera_ray(camera_, centre, glm::vec2(WIDTH_PX, HEIGHT_PX));
            const RayRecord ray{view.origin, RAY_INFINITY, view.direction, pixel};
            const auto hit = scene_->tracer->trace_closest(ray, {0, 0, RAY_CAMERA}, BackFaces::PASS);
            const glm::uvec2 met = hit ? glm::uvec2(hit->instance, hit->primitive) : glm::uvec2(INVALID_INDEX);
            if (seen[pixel].x != met.x || (hit && seen[pixel].y != met.y)) silhouettes_.push_back(pixel);
        }
        std::printf("%s: %zu of %zu pixels on silhouettes left out\n", GetParam(), silhouettes_.size(), seen.size());
        EXPECT_LE(silhouettes_.size(), seen.size() / 200);
    }

    static void clear_silhouettes(Image& image) {
        for (const std::uint32_t pixel : silhouettes_) {
            for (int channel = 0; channel < 3; ++channel) image.values[3 * pixel + channel] = 0.0f;
        }
    }

    static Image render_mean(Renderer& renderer, FrameInput input) {
        Image mean(WIDTH_PX, HEIGHT_PX, 3);
        for (int frame = 0; frame < FRAMES; ++frame) {
            input.frame = std::uint32_t(frame);
            const Image image = renderer.read_radiance(renderer.render(input).radiance);
            for (std::size_t i = 0; i < mean.values.size(); ++i) mean.values[i] += image.values[i] / float(FRAMES);
        }
        return mean;
    }

    TileTest run(DirectMode mode, int seeds, const std::vector<std::string>& planted = {}) {
        Renderer renderer(scene_->world, *scene_->tracer, WIDTH_PX, HEIGHT_PX, planted);
        FrameInput input;
        input.camera = camera_;
        input.settings.direct = mode;
        TileSamples samples(WIDTH_PX, HEIGHT_PX, TILE_PX);
        for (int seed = 0; seed < seeds; ++seed) {
            input.seed = std::uint32_t(seed) + 1000u;
            Image image = render_mean(renderer, input);
            clear_silhouettes(image);
            samples.add(image);
        }
        for (const auto& [name, value] : renderer.read_counters()) EXPECT_EQ(value, 0u) << name;
        const TileTest test = samples.test(reference_, SIGNIFICANCE);
        std::printf("%s: smallest p %.3g, threshold %.3g; worst tile at (%d, %d), %d px: %.6g against %.6g\n",
                    GetParam(), test.min_p_value, test.threshold, test.x, test.y, test.size_px, test.mean,
                    test.reference_mean);
        return test;
    }

    static inline std::unique_ptr<Context> context_;
    static inline std::string loaded_;
    static inline std::unique_ptr<TestScene> scene_;
    static inline CameraRecord camera_{};
    static inline TileReference reference_;
    static inline std::vector<std::uint32_t> silhouettes_;
};

TEST_P(DirectLight, UniformHasTheReferencesMean) {
    EXPECT_TRUE(run(DirectMode::UNIFORM, SEEDS).passes);
}

TEST_P(DirectLight, RisHasTheReferencesMean) {
    EXPECT_TRUE(run(DirectMode::RIS, SEEDS).passes);
}

TEST_P(DirectLight, PlantedBugsAreFound) {
    for (const char* bug : {"TARN_PLANT_DROP_PDF", "TARN_PLANT_DROP_COSINE", "TARN_PLANT_SHIFT_LIGHT"}) {
        // The two lights of the Cornell box are the halves of one quad: to take one for the other changes nothing.
        const bool harmless = bug == std::string("TARN_PLANT_SHIFT_LIGHT") && GetParam() == std::string("cornell");
        if (harmless) continue;
        EXPECT_FALSE(run(DirectMode::RIS, SEEDS_TO_FIND_A_BUG, {bug}).passes) << bug;
    }
}

INSTANTIATE_TEST_SUITE_P(Scenes, DirectLight,
                         testing::Values("cornell", "lantern_court", "VeachMIS", "CyberpunkManyLights"),
                         [](const auto& info) { return std::string(info.param); });

}  // namespace
}  // namespace tarn::test
