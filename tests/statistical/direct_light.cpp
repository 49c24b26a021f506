// The mean of many seeds of each mode of direct light equals the reference: per-tile test with Sidak
// correction. And three classic mistakes, planted one at a time, are found by the same test.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <set>

#include "core/tile_test.h"
#include "platform/context.h"
#include "reference/reference.h"
#include "renderer/renderer.h"
#include "shared/math/random.h"
#include "support/test_scenes.h"
#include "world/scene_access.h"

namespace tarn::test {
namespace {

// Small pictures: the statistics need seeds, not pixels.
constexpr int WIDTH_PX = 96;
constexpr int HEIGHT_PX = 54;
constexpr int TILE_PX = 16;
constexpr int SEEDS = 256;
// Frames averaged into each seed's image. Glossy highlights and distant lanterns are rare bright events: over
// single frames 256 seeds meet some of them too seldom for the test's correction for skewness.
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
        left_out_ = find_silhouettes();
        // The one scene with seldom drawn lights at arm's length of what they light.
        if (GetParam() == std::string("lantern_court")) left_out_.merge(find_rare_events());
        clear_left_out(reference_.mean);
        clear_left_out(reference_.variance);
    }

    // Pixels where the two differ for any of some frames: where surfaces of partial coverage meet a
    // silhouette, it takes several draws to see it.
    static std::set<std::uint32_t> find_silhouettes() {
        Renderer renderer(scene_->world, *scene_->tracer, WIDTH_PX, HEIGHT_PX);
        FrameInput input;
        input.camera = camera_;
        std::set<std::uint32_t> found;
        for (input.frame = 0; input.frame < 32; ++input.frame) {
            const auto seen = renderer.render(input).gbuffer.seen.download<glm::uvec2>();
            for (std::uint32_t pixel = 0; pixel < seen.size(); ++pixel) {
                if (seen[pixel] != trace_seen(pixel, input.frame)) found.insert(pixel);
            }
        }
        std::printf("%s: %zu of %d pixels are on silhouettes\n", GetParam(), found.size(),
                    WIDTH_PX * HEIGHT_PX);
        EXPECT_LE(found.size(), std::size_t(WIDTH_PX * HEIGHT_PX / 200));
        return found;
    }

    // Pixels within one radius of the lit side of a triangle that is drawn less than 16 times a pixel in
    // all. Nearer than that the square of the distance varies strongly over the triangle. Both limits were
    // set after results were seen: 64 draws and three radii left out 16 % of the picture.
    static std::set<std::uint32_t> find_rare_events() {
        Renderer renderer(scene_->world, *scene_->tracer, WIDTH_PX, HEIGHT_PX);
        FrameInput input;
        input.camera = camera_;
        const auto positions = renderer.render(input).gbuffer.position().download<glm::vec4>();
        const double draws = double(input.settings.candidates) * FRAMES * SEEDS;
        SceneAccess access(scene_->world);
        std::set<std::uint32_t> found;
        for (std::uint32_t i = scene_->world.lights.punctual_count; i < scene_->world.lights.count; ++i) {
            if (scene_->world.lights.pmf[i] * draws >= 16.0) continue;
            const Light light = access.load_light(i);
            const glm::vec3 centre = triangle_point(light, glm::vec2(1.0f / 3.0f));
            const float radius = std::max(glm::length(light.edge1), glm::length(light.edge2));
            const float side = (light.flags & LIGHT_MIRRORED) != 0u ? -1.0f : 1.0f;
            const glm::vec3 normal = side * glm::normalize(glm::cross(light.edge1, light.edge2));
            for (std::uint32_t pixel = 0; pixel < positions.size(); ++pixel) {
                const glm::vec3 from_light = glm::vec3(positions[pixel]) - centre;
                const bool is_lit =
                    positions[pixel].w >= 0.0f && glm::dot(from_light, normal) > 0.01f * radius;
                if (is_lit && glm::length(from_light) < radius) found.insert(pixel);
            }
        }
        std::printf("%s: %zu pixels are too close to a light that is seldom drawn\n", GetParam(),
                    found.size());
        EXPECT_LE(found.size(), std::size_t(WIDTH_PX * HEIGHT_PX / 50));
        return found;
    }

    // Instance and primitive that the camera ray of a pixel meets, as the rasterizer would write them.
    static glm::uvec2 trace_seen(std::uint32_t pixel, std::uint32_t frame) {
        const glm::vec2 centre(float(pixel % WIDTH_PX) + 0.5f, float(pixel / WIDTH_PX) + 0.5f);
        const PixelRay view = camera_ray(camera_, centre, glm::vec2(WIDTH_PX, HEIGHT_PX));
        const RayRecord ray{view.origin, RAY_INFINITY, view.direction, pixel};
        const auto hit = scene_->tracer->trace_closest(ray, {frame, 0, RAY_CAMERA}, BackFaces::PASS);
        return hit ? glm::uvec2(hit->instance, hit->primitive) : glm::uvec2(INVALID_INDEX);
    }

    static void clear_left_out(Image& image) {
        for (const std::uint32_t pixel : left_out_) {
            for (int channel = 0; channel < 3; ++channel) image.values[3 * pixel + channel] = 0.0f;
        }
    }

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

    TileTest run(DirectMode mode, int seeds, const std::vector<std::string>& planted = {}) {
        Renderer renderer(scene_->world, *scene_->tracer, WIDTH_PX, HEIGHT_PX, planted);
        FrameInput input;
        input.camera = camera_;
        input.settings.direct = mode;
        TileSamples samples(WIDTH_PX, HEIGHT_PX, TILE_PX);
        for (int seed = 0; seed < seeds; ++seed) {
            input.seed = std::uint32_t(seed) + 1000u;
            Image image = render_mean(renderer, input);
            clear_left_out(image);
            samples.add(image);
        }
        for (const auto& [name, value] : renderer.read_counters()) EXPECT_EQ(value, 0u) << name;
        const TileTest test = samples.test(reference_, SIGNIFICANCE);
        std::printf(
            "%s: smallest p %.3g, threshold %.3g, %.0f %% of tests pooled; worst tile at (%d, %d), %d px: "
            "%.6g against %.6g\n",
            GetParam(), test.min_p_value, test.threshold, 100.0 * test.pooled_fraction, test.x, test.y,
            test.size_px, test.mean, test.reference_mean);
        return test;
    }

    static inline std::unique_ptr<Context> context_;
    static inline std::string loaded_;
    static inline std::unique_ptr<TestScene> scene_;
    static inline CameraRecord camera_{};
    static inline TileReference reference_;
    static inline std::set<std::uint32_t> left_out_;
};

TEST_P(DirectLight, UniformHasTheReferencesMean) {
    EXPECT_TRUE(run(DirectMode::UNIFORM, SEEDS).passes);
}

TEST_P(DirectLight, RisHasTheReferencesMean) {
    EXPECT_TRUE(run(DirectMode::RIS, SEEDS).passes);
}

TEST_P(DirectLight, PlantedBugsAreFound) {
    for (const char* bug : {"TARN_PLANT_DROP_PDF", "TARN_PLANT_DROP_COSINE", "TARN_PLANT_SHIFT_LIGHT"}) {
        // The two lights of the Cornell box are the halves of one quad: to take one for the other changes
        // nothing.
        const bool harmless =
            bug == std::string("TARN_PLANT_SHIFT_LIGHT") && GetParam() == std::string("cornell");
        if (harmless) continue;
        EXPECT_FALSE(run(DirectMode::RIS, SEEDS_TO_FIND_A_BUG, {bug}).passes) << bug;
    }
}

INSTANTIATE_TEST_SUITE_P(Scenes, DirectLight,
                         testing::Values("cornell", "lantern_court", "VeachMIS", "CyberpunkManyLights"),
                         [](const auto& info) { return std::string(info.param); });

}  // namespace
}  // namespace tarn::test
