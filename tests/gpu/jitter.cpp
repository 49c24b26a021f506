// Rays through other places of a pixel than its centre: raster and rays move together, and nothing is lost at
// the edges.
#include <gtest/gtest.h>

#include "renderer/renderer.h"
#include "shared/math/random.h"
#include "support/on_context.h"
#include "support/test_scenes.h"

namespace tarn::test {
namespace {

constexpr int WIDTH_PX = 96;
constexpr int HEIGHT_PX = 54;

class Jitter : public OnContext<testing::TestWithParam<PrimaryVisibility>> {
  protected:
    Jitter()
        : scene_(load_test_scene(content_file("cornell"))),
          renderer_(scene_->world, *scene_->tracer, WIDTH_PX, HEIGHT_PX) {
        // Near enough that the walls leave the picture on all sides.
        input_.camera = first_camera(*scene_, double(WIDTH_PX) / HEIGHT_PX);
        input_.settings.primary.visibility = GetParam();
    }

    // What each pixel sees, row by row.
    std::vector<glm::uvec2> see(const glm::vec2& jitter_px) {
        input_.jitter_px = jitter_px;
        return renderer_.render(input_).gbuffer.seen->download<glm::uvec2>();
    }
    std::vector<glm::vec4> find_positions(const glm::vec2& jitter_px) {
        input_.jitter_px = jitter_px;
        return renderer_.render(input_).gbuffer.surfaces->download(LAYER_POSITION);
    }
    glm::uvec2 trace(int x, int y, const glm::vec2& jitter_px) const {
        const glm::vec2 place = glm::vec2(float(x), float(y)) + 0.5f + jitter_px;
        const PixelRay view = camera_ray(input_.camera, place, glm::vec2(WIDTH_PX, HEIGHT_PX));
        const RayRecord ray{view.origin, RAY_INFINITY, view.direction, 0u};
        const auto hit = scene_->tracer->trace_closest(ray, {0, 0, RAY_CAMERA}, BackFaces::PASS);
        return hit ? glm::uvec2(hit->instance, hit->primitive) : glm::uvec2(INVALID_INDEX);
    }

    std::unique_ptr<TestScene> scene_;
    Renderer renderer_;
    FrameInput input_;
};

TEST_P(Jitter, RasterAndRaysMoveTogether) {
    for (const glm::vec2& jitter : {glm::vec2(0.0f), glm::vec2(0.4f, -0.3f), glm::vec2(-0.5f, 0.5f)}) {
        const std::vector<glm::uvec2> seen = see(jitter);
        int different = 0;
        for (int y = 0; y < HEIGHT_PX; ++y) {
            for (int x = 0; x < WIDTH_PX; ++x) {
                different += seen[std::size_t(y * WIDTH_PX + x)] != trace(x, y, jitter) ? 1 : 0;
            }
        }
        // Pixels whose place lies on an edge, to within the rasterizer's 256th of a pixel.
        EXPECT_LE(different, WIDTH_PX * HEIGHT_PX / 200) << jitter.x << ", " << jitter.y;
    }
}

TEST_P(Jitter, AWholePixelShiftsThePicture) {
    const std::vector<glm::vec4> still = find_positions(glm::vec2(0.0f));
    const std::vector<glm::vec4> moved = find_positions(glm::vec2(1.0f, -2.0f));
    int different = 0;
    for (int y = 2; y < HEIGHT_PX; ++y) {
        for (int x = 0; x + 1 < WIDTH_PX; ++x) {
            const glm::vec4 expected = still[std::size_t((y - 2) * WIDTH_PX + x + 1)];
            const glm::vec4 found = moved[std::size_t(y * WIDTH_PX + x)];
            different += glm::length(glm::vec3(expected - found)) > 1e-4f ? 1 : 0;
        }
    }
    EXPECT_LE(different, WIDTH_PX * HEIGHT_PX / 500);
}

TEST_P(Jitter, WithoutItNothingChanges) {
    const std::vector<glm::uvec2> first = see(glm::vec2(0.0f));
    see(glm::vec2(0.25f, 0.25f));
    EXPECT_EQ(see(glm::vec2(0.0f)), first);
}

INSTANTIATE_TEST_SUITE_P(DrawnBy, Jitter, testing::Values(PrimaryVisibility::RASTER, PrimaryVisibility::RAYS),
                         [](const auto& info) {
                             return info.param == PrimaryVisibility::RASTER ? "raster" : "rays";
                         });

}  // namespace
}  // namespace tarn::test
