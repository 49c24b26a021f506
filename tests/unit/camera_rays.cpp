// Batches of camera rays: each pixel gets what its own ray meets first, whatever packet it travels in.
#include <gtest/gtest.h>

#include "rays/ray_tracer.h"
#include "shared/math/random.h"
#include "support/ray_soup.h"

namespace tarn::test {
namespace {

// No whole number of packets or of tiles either way.
constexpr glm::ivec2 SIZE_PX(149, 83);
constexpr CoverageKey KEY{3, 5, RAY_CAMERA};

CameraRays look_at_soup(bool orthographic, const glm::vec2& jitter_px = glm::vec2(0.0f)) {
    CameraRecord camera;
    camera.position = {0.5f, 0.3f, 6.0f};
    camera.forward = {0.0f, 0.0f, -1.0f};
    camera.right = {orthographic ? 4.0f : 0.7f, 0.0f, 0.0f};
    camera.up = {0.0f, orthographic ? 2.2f : 0.4f, 0.0f};
    camera.orthographic = orthographic;
    return {camera, SIZE_PX, jitter_px};
}

std::vector<glm::uvec2> trace(const RayTracer& tracer, const CameraRays& rays) {
    std::vector<glm::uvec2> seen(std::size_t(SIZE_PX.x * SIZE_PX.y), glm::uvec2(7u));
    EXPECT_EQ(tracer.trace_camera_rays(rays, seen, KEY), seen.size());
    return seen;
}

// The same, ray by ray.
std::vector<glm::uvec2> trace_each(const RayTracer& tracer, const CameraRays& rays) {
    std::vector<glm::uvec2> seen;
    for (int y = 0; y < SIZE_PX.y; ++y) {
        for (int x = 0; x < SIZE_PX.x; ++x) {
            const glm::vec2 place = glm::vec2(float(x), float(y)) + 0.5f + rays.jitter_px;
            const PixelRay view = camera_ray(rays.camera, place, glm::vec2(SIZE_PX));
            const RayRecord ray{view.origin, RAY_INFINITY, view.direction, std::uint32_t(seen.size())};
            const Hit hit = tracer.trace_closest(ray, KEY, BackFaces::PASS).value_or(Hit{});
            seen.emplace_back(hit.instance, hit.primitive);
        }
    }
    return seen;
}

int count_hits(const std::vector<glm::uvec2>& seen) {
    return int(std::count_if(seen.begin(), seen.end(),
                             [](const glm::uvec2& pixel) { return pixel.x != INVALID_INDEX; }));
}

int count_different(const std::vector<glm::uvec2>& a, const std::vector<glm::uvec2>& b) {
    int count = 0;
    for (std::size_t i = 0; i < a.size(); ++i) count += a[i] != b[i] ? 1 : 0;
    return count;
}

// Every fifth instance of the soup is flat, and so are its triangles at one distance from all rays.
void make_solid(World& world) {
    for (std::uint32_t i = 4; i < world.instances.size(); i += 5) {
        world.instances[i].world_from_object = world.instances[i - 4].world_from_object;
        world.instances[i].world_from_object[3].x += 0.7f;
        world.instances[i].mirrored = world.instances[i - 4].mirrored;
        ++world.instances[i].revision;
    }
}

class CameraRaysOfSoup : public testing::TestWithParam<bool> {};

TEST_P(CameraRaysOfSoup, AreThoseOfEachPixel) {
    const bool orthographic = GetParam();
    World world = make_soup(true);
    make_solid(world);
    const auto embree = create_embree_tracer(world);
    const auto oracle = create_brute_force_tracer(world);
    for (const glm::vec2& jitter_px : {glm::vec2(0.0f), glm::vec2(0.4f, -0.3f)}) {
        const CameraRays rays = look_at_soup(orthographic, jitter_px);
        const std::vector<glm::uvec2> seen = trace(*embree, rays);
        EXPECT_GT(count_hits(seen), int(seen.size()) / 5);
        EXPECT_LT(count_hits(seen), int(seen.size()));
        EXPECT_LE(count_different(seen, trace_each(*embree, rays)), 2);
        EXPECT_LE(count_different(seen, trace_each(*oracle, rays)), int(seen.size()) / 1000);
        EXPECT_EQ(trace(*oracle, rays), trace_each(*oracle, rays));
    }
}

INSTANTIATE_TEST_SUITE_P(Cameras, CameraRaysOfSoup, testing::Bool());

// Instances beside the still scene: of their hits, normals are those of object space.
TEST(CameraRays, MeetWhatMovesFromItsFront) {
    World world = make_soup(false);
    make_solid(world);
    const auto embree = create_embree_tracer(world);
    Rng rng(23);
    for (WorldInstance& instance : world.instances) {
        instance.world_from_object[3] += glm::vec4(random_point(rng, 0.5f), 0.0f);
        ++instance.revision;
    }
    embree->update(world);
    const CameraRays rays = look_at_soup(false);
    const std::vector<glm::uvec2> seen = trace(*embree, rays);
    const auto oracle = create_brute_force_tracer(world);
    EXPECT_LE(count_different(seen, trace_each(*embree, rays)), 2);
    EXPECT_LE(count_different(seen, trace_each(*oracle, rays)), int(seen.size()) / 1000);
}

TEST(CameraRays, DoNotDependOnTheNumberOfThreads) {
    const World world = make_soup(true);
    std::vector<glm::uvec2> seen[2];
    for (int threads = 1; threads <= 2; ++threads) {
        const WorkerLimit limit(threads);
        seen[threads - 1] = trace(*create_embree_tracer(world), look_at_soup(false));
    }
    EXPECT_EQ(seen[0], seen[1]);
}

TEST(CameraRays, MeetNothingInAnEmptyWorld) {
    const World world = build_world(Scene{});
    EXPECT_EQ(count_hits(trace(*create_embree_tracer(world), look_at_soup(false))), 0);
}

}  // namespace
}  // namespace tarn::test
