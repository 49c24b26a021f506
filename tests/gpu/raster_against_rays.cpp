// The rasterizer and the ray tracer see the same triangle at the same place in every pixel, whichever of them
// draws, and shadow rays neither start below their surface nor leak through it, wherever the scene lies.
#include <gtest/gtest.h>

#include <cstdio>

#include "renderer/renderer.h"
#include "shared/math/random.h"
#include "support/on_context.h"
#include "support/test_scenes.h"

namespace tarn::test {
namespace {

constexpr int WIDTH_PX = 640;
constexpr int HEIGHT_PX = 360;

struct Agreement {
    int pixels = 0;
    int same_triangle = 0;  // or both see nothing
    int surfaces = 0;       // pixels where both see the same triangle
    int same_position = 0;  // of those, within 1e-5 of the distance
    double worst_position = 0.0;
};

class RasterAgainstRays : public OnContext<> {
  protected:
    Agreement compare(TestScene& scene, const CameraRecord& camera, PrimaryVisibility drawn_by) {
        Renderer renderer(scene.world, *scene.tracer, WIDTH_PX, HEIGHT_PX);
        FrameInput input;
        input.camera = camera;
        input.settings.primary.visibility = drawn_by;
        const FrameOutput output = renderer.render(input);
        const auto seen = output.gbuffer.seen->download<glm::uvec2>();
        const auto position = output.gbuffer.surfaces->download(LAYER_POSITION);
        Agreement a;
        for (int y = 0; y < HEIGHT_PX; ++y) {
            for (int x = 0; x < WIDTH_PX; ++x) {
                const std::uint32_t pixel = std::uint32_t(y * WIDTH_PX + x);
                const PixelRay view = camera_ray(camera, vec2(x + 0.5f, y + 0.5f), vec2(WIDTH_PX, HEIGHT_PX));
                RayRecord ray{view.origin, RAY_INFINITY, view.direction, pixel};
                const auto hit = scene.tracer->trace_closest(ray, {0, 0, RAY_CAMERA}, BackFaces::PASS);
                const glm::uvec2 met =
                    hit ? glm::uvec2(hit->instance, hit->primitive) : glm::uvec2(INVALID_INDEX);
                ++a.pixels;
                if (seen[pixel].x != met.x || (hit && seen[pixel].y != met.y)) continue;
                ++a.same_triangle;
                if (!hit) continue;
                const glm::dvec3 met_at =
                    glm::dvec3(view.origin) + glm::dvec3(view.direction) * double(hit->t);
                const double error = glm::length(glm::dvec3(position[pixel]) - met_at) / double(hit->t);
                ++a.surfaces;
                if (error <= 1e-5) ++a.same_position;
                a.worst_position = std::max(a.worst_position, error);
            }
        }
        return a;
    }

    void expect_agreement(const std::filesystem::path& file) {
        if (!std::filesystem::exists(file)) GTEST_SKIP() << file.string() << " is not here";
        const auto scene = load_test_scene(file);
        const CameraRecord camera = first_camera(*scene, double(WIDTH_PX) / HEIGHT_PX);
        expect_agreement(compare(*scene, camera, PrimaryVisibility::RASTER), 0.995);
        // But for triangles that lie in one place.
        expect_agreement(compare(*scene, camera, PrimaryVisibility::RAYS), 0.9999);
    }

    static void expect_agreement(const Agreement& a, double least_same) {
        const double same = double(a.same_triangle) / a.pixels, placed = double(a.same_position) / a.surfaces;
        std::printf(
            "same triangle in %.3f %% of %d pixels; same position in %.3f %% of %d, worst %.2g of the "
            "distance\n",
            100.0 * same, a.pixels, 100.0 * placed, a.surfaces, a.worst_position);
        EXPECT_GT(a.surfaces, a.pixels / 20);
        EXPECT_GE(same, least_same);
        EXPECT_GE(placed, 0.999);
    }
};

TEST_F(RasterAgainstRays, LanternCourt) {
    expect_agreement(content_file("lantern_court"));
}

TEST_F(RasterAgainstRays, Sponza) {
    expect_agreement(shared_file("SponzaDabrovic/SponzaDabrovic.gltf"));
}

TEST_F(RasterAgainstRays, MetalRoughSpheres) {
    expect_agreement(shared_file("MetalRoughSpheresNoTextures/MetalRoughSpheresNoTextures.glb"));
}

TEST_F(RasterAgainstRays, MaskedAndBlendedSurfaces) {
    expect_agreement(shared_file("AlphaBlendModeTest/AlphaBlendModeTest.glb"));
}

// The court has 65 triangles for each of these pixels, the Cornell box few for any picture.
TEST_F(RasterAgainstRays, RaysDrawWhereTheCpuWouldRasterizeManyTriangles) {
    constexpr int SMALL_WIDTH_PX = 64, SMALL_HEIGHT_PX = 36;
    const bool is_software = context_->device_info().is_software;
    for (const char* name : {"lantern_court", "cornell"}) {
        const auto scene = load_test_scene(content_file(name));
        Renderer renderer(scene->world, *scene->tracer, SMALL_WIDTH_PX, SMALL_HEIGHT_PX);
        FrameInput input;
        input.camera = first_camera(*scene, double(SMALL_WIDTH_PX) / SMALL_HEIGHT_PX);
        const bool by_rays = is_software && name == std::string("lantern_court");
        const FrameOutput output = renderer.render(input);
        EXPECT_EQ(output.camera_rays, by_rays ? std::uint64_t(SMALL_WIDTH_PX * SMALL_HEIGHT_PX) : 0u) << name;
        EXPECT_EQ(output.raster.triangles_drawn > 0u, !by_rays) << name;
    }
}

// ---- Acne and leaks
// -------------------------------------------------------------------------------------------------

class WorldOffset : public RasterAgainstRays, public testing::WithParamInterface<double> {};

TEST_P(WorldOffset, RasterAndRaysStillAgree) {
    const auto scene = load_test_scene(content_file("lantern_court"), glm::dvec3(GetParam()));
    const CameraRecord camera = first_camera(*scene, double(WIDTH_PX) / HEIGHT_PX);
    expect_agreement(compare(*scene, camera, PrimaryVisibility::RASTER), 0.995);
    expect_agreement(compare(*scene, camera, PrimaryVisibility::RAYS), 0.9999);
}

// The Cornell box against itself at the origin. That nothing is wrong at the origin either is shown in
// absolute terms by tests/hard_cases/scale_and_offset.cpp.
TEST_P(WorldOffset, TheCornellBoxHasNoAcneAndNoLeaks) {
    const double offset_m = GetParam();
    const auto scene =
        load_test_scene(content_file("cornell"), glm::dvec3(offset_m, -0.5 * offset_m, offset_m));
    const auto at_origin = load_test_scene(content_file("cornell"));
    const double aspect = double(WIDTH_PX) / HEIGHT_PX;
    const auto render = [&](TestScene& s) {
        Renderer renderer(s.world, *s.tracer, WIDTH_PX, HEIGHT_PX);
        FrameInput input;
        input.camera = first_camera(s, aspect);
        Image sum(WIDTH_PX, HEIGHT_PX, 3);
        for (std::uint32_t frame = 0; frame < 16; ++frame) {
            input.frame = frame;
            const Image image = renderer.read_radiance(renderer.render(input).radiance);
            for (std::size_t i = 0; i < sum.values.size(); ++i) sum.values[i] += image.values[i] / 16.0f;
        }
        return sum;
    };
    const Image moved = render(*scene), still = render(*at_origin);
    // Same random numbers, same geometry up to rounding: a pixel that turned black (acne) or lit up (a leak)
    // stands out. Penumbras flip a ray here and there, which 16 frames average.
    int black = 0, lit = 0, pixels = 0;
    for (int y = 0; y < HEIGHT_PX; ++y) {
        for (int x = 0; x < WIDTH_PX; ++x) {
            const float a = still.pixel(x, y)[1], b = moved.pixel(x, y)[1];
            ++pixels;
            if (a > 1e-4f && b == 0.0f) ++black;
            if (a == 0.0f && b > 1e-4f) ++lit;
        }
    }
    std::printf("offset %g m: %d pixels turned black, %d lit up, of %d\n", offset_m, black, lit, pixels);
    EXPECT_LE(black, pixels / 20000);
    EXPECT_LE(lit, pixels / 20000);
}

INSTANTIATE_TEST_SUITE_P(Metres, WorldOffset, testing::Values(1e3, 1e5));

}  // namespace
}  // namespace tarn::test
