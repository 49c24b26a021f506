// The GL renderer against answers that are known: a rectangle over a plane, a sphere in an even sky, white
// furnaces. Each claim is also made of a renderer with a planted mistake, and must fail there.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <functional>

#include "core/statistics.h"
#include "scene/gltf_import.h"
#include "support/on_context.h"
#include "support/test_scenes.h"
#include "support/tile_test.h"
#include "support/toy_render.h"

namespace tarn::test {
namespace {

constexpr double DOUBLE_PI = 3.14159265358979323846;
constexpr double SIGNIFICANCE = 0.01;
const DirectMode MODES[] = {DirectMode::UNIFORM, DirectMode::RIS};

const char* name_of(DirectMode mode) {
    return mode == DirectMode::UNIFORM ? "uniform" : "ris";
}

class GlClosedForms : public OnContext<> {};

using Defines = std::vector<std::string>;

// ---- Tile by tile -------------------------------------------------------------------------------

constexpr int WIDTH_PX = 96;
constexpr int HEIGHT_PX = 54;
constexpr int SEEDS = 256;
constexpr int SEEDS_TO_FIND_A_BUG = 32;
constexpr int FRAMES = 4;  // averaged into each seed's image

// Radiance that the pixel should have on average; `on_surface`: it sees instance 0, not the sky.
using Expectation = std::function<glm::dvec3(int x, int y, bool on_surface)>;

// Tests the mean of many independent images, tile by tile, against what is known without any error. Every
// frame number is a seed of its own.
TileTest test_mean(ToyRender& render, const CameraRecord& camera, DirectMode mode, int seeds,
                   const Expectation& expected) {
    TileSamples samples(WIDTH_PX, HEIGHT_PX);
    for (int seed = 0; seed < seeds; ++seed) {
        samples.add(render.render(camera, mode, FRAMES, FRAMES * seed));
    }
    TileReference known{Image(WIDTH_PX, HEIGHT_PX, 3), Image(WIDTH_PX, HEIGHT_PX, 3)};
    for (int y = 0; y < HEIGHT_PX; ++y) {
        for (int x = 0; x < WIDTH_PX; ++x) {
            const glm::dvec3 value = expected(x, y, render.seen_instance(x, y) == 0);
            for (int c = 0; c < 3; ++c) known.mean.pixel(x, y)[c] = float(value[c]);
        }
    }
    const TileTest test = samples.test(known, SIGNIFICANCE);
    fmt::print("{}: {}\n", name_of(mode), describe(test));
    // Nothing here is rare: each tile is to be tested as itself.
    EXPECT_EQ(test.pooled_fraction, 0.0);
    return test;
}

// Share of the cosine-weighted hemisphere of a place on the plane that is covered by a parallel rectangle
// with one corner right above it, `x` and `z` its edges over its height: the configuration factor of a
// differential element to a parallel rectangle. Odd in both, so that any rectangle is a sum of four.
double corner_factor(double x, double z) {
    const double root_x = std::sqrt(1.0 + x * x), root_z = std::sqrt(1.0 + z * z);
    return (x / root_x * std::atan(z / root_x) + z / root_z * std::atan(x / root_z)) / (2.0 * DOUBLE_PI);
}

// Radiance of the plane of `rectangle_over_plane` at `p`: albedo 0.5 under [-0.5, 0.5] x {1} x [-0.25, 0.25]
// of radiance 5.
double rectangle_radiance(const glm::dvec3& p) {
    const double left = -0.5 - p.x, right = 0.5 - p.x, back = -0.25 - p.z, front = 0.25 - p.z;
    const double factor = corner_factor(right, front) - corner_factor(left, front) -
                          corner_factor(right, back) + corner_factor(left, back);
    return 0.5 * 5.0 * factor;
}

TileTest test_rectangle(DirectMode mode, int seeds, const Defines& planted = {}) {
    ToyRender render(load_gltf(content_file("rectangle_over_plane")), WIDTH_PX, HEIGHT_PX, {}, planted);
    const CameraRecord camera = render.first_camera();
    const glm::dvec3 eye = render.camera_position_ws(camera);
    return test_mean(render, camera, mode, seeds, [&](int x, int y, bool on_plane) {
        const glm::dvec3 direction = render.ray_direction(camera, x, y);
        return on_plane ? glm::dvec3(rectangle_radiance(eye - direction * (eye.y / direction.y)))
                        : glm::dvec3(0.0);
    });
}

TEST_F(GlClosedForms, ARectangleLightsAPlaneAsItsConfigurationFactorSays) {
    for (const DirectMode mode : MODES) EXPECT_TRUE(test_rectangle(mode, SEEDS).passes) << name_of(mode);
}

TEST_F(GlClosedForms, PlantedBugsShowUnderARectangle) {
    for (const DirectMode mode : MODES) {
        for (const char* bug : {"TARN_PLANT_DROP_PDF", "TARN_PLANT_DROP_COSINE"}) {
            EXPECT_FALSE(test_rectangle(mode, SEEDS_TO_FIND_A_BUG, {bug}).passes) << name_of(mode) << bug;
        }
    }
}

// A convex Lambert body reflects albedo x sky everywhere: irradiance is pi x sky, the BRDF albedo / pi.
TileTest test_sphere(DirectMode mode, int seeds, const Defines& planted = {}) {
    const glm::vec3 albedo(0.5f, 0.25f, 0.9f), sky(2.0f, 1.0f, 3.0f);
    ToyScene toy;
    toy.add_instance(toy.add_mesh(toy.add_material(lambert_material(albedo)), sphere_corners(1.0f, 24)));
    ToyRender render(toy.scene, WIDTH_PX, HEIGHT_PX, even_sky(sky), planted);
    const CameraRecord camera = render.look({0.0, 0.5, 3.0}, {0.0, 0.0, 0.0}, 45.0);
    return test_mean(render, camera, mode, seeds,
                     [&](int, int, bool on_sphere) { return glm::dvec3(on_sphere ? albedo * sky : sky); });
}

TEST_F(GlClosedForms, ASphereInAnEvenSkyReflectsItsAlbedo) {
    for (const DirectMode mode : MODES) EXPECT_TRUE(test_sphere(mode, SEEDS).passes) << name_of(mode);
}

TEST_F(GlClosedForms, PlantedBugsShowOnASphereInAnEvenSky) {
    for (const DirectMode mode : MODES) {
        for (const char* bug : {"TARN_PLANT_DROP_PDF", "TARN_PLANT_DROP_COSINE"}) {
            EXPECT_FALSE(test_sphere(mode, SEEDS_TO_FIND_A_BUG, {bug}).passes) << name_of(mode) << bug;
        }
    }
}

// ---- White furnaces -----------------------------------------------------------------------------

constexpr int FURNACE_PX = 512;
// Least excess or lack that matters, and the standard error from which such claims have power.
constexpr double FURNACE_TOLERANCE = 1e-3;
constexpr double FURNACE_ERROR = 2.5e-4;
// By so much the BRDF may darken white surfaces: its albedos are fits.
constexpr double BRDF_TOLERANCE = 1e-2;

// Adds `frames` frames from `first_frame` on to each instance's moments, a frame's mean over the instance's
// pixels being one number: the spread of these numbers is the error, whatever the correlation within a frame.
void add_instance_means(ToyRender& render, const CameraRecord& camera, DirectMode mode, int first_frame,
                        int frames, std::vector<RunningMoments>& moments) {
    moments.resize(render.world().instances.size());
    for (int frame = first_frame; frame < first_frame + frames; ++frame) {
        const Image image = render.render(camera, mode, 1, frame);
        std::vector<double> sums(moments.size());
        std::vector<int> counts(moments.size());
        for (int y = 0; y < image.height; ++y) {
            for (int x = 0; x < image.width; ++x) {
                const std::uint32_t seen = render.seen_instance(x, y);
                if (seen == INVALID_INDEX) continue;
                sums[seen] += image.pixel(x, y)[1];
                ++counts[seen];
            }
        }
        for (std::size_t i = 0; i < moments.size(); ++i) {
            EXPECT_GT(counts[i], 10000) << "pixels of instance " << i;
            moments[i].add(sums[i] / std::max(1, counts[i]));
        }
    }
}

RunningMoments measure_lambert_furnace(DirectMode mode, int frames, const Defines& planted = {}) {
    ToyRender render(load_gltf(content_file("furnace")), FURNACE_PX, FURNACE_PX, {}, planted);
    std::vector<RunningMoments> moments;
    add_instance_means(render, render.first_camera(), mode, 0, frames, moments);
    const RunningMoments& sphere = moments.at(0);
    std::printf("%s: %.6f +- %.6f\n", name_of(mode), sphere.mean(), std::sqrt(sphere.variance_of_mean()));
    return sphere;
}

TEST_F(GlClosedForms, AWhiteLambertSphereVanishesInAWhiteFurnace) {
    for (const DirectMode mode : MODES) {
        const RunningMoments sphere = measure_lambert_furnace(mode, mode == DirectMode::UNIFORM ? 320 : 16);
        EXPECT_LT(std::sqrt(sphere.variance_of_mean()), FURNACE_ERROR) << name_of(mode);
        EXPECT_NEAR(sphere.mean(), 1.0, FURNACE_TOLERANCE) << name_of(mode);
    }
}

TEST_F(GlClosedForms, PlantedBugsShowInALambertFurnace) {
    for (const char* bug : {"TARN_PLANT_DROP_PDF", "TARN_PLANT_DROP_COSINE"}) {
        EXPECT_GT(std::abs(measure_lambert_furnace(DirectMode::RIS, 4, {bug}).mean() - 1.0), 0.1) << bug;
    }
}

// A narrow highlight meets a random direction of the sky too seldom for a mean with a small error. But
// radiance is linear in the sky: an even one is a sum of bands around the mirror direction, within each of
// which the highlight varies little. Bilinear lookup keeps the sum at exactly 1.
constexpr int SKY_ROWS = 4096;  // a row is 0.77e-3 rad high; the narrowest highlight is 2e-3 rad wide
constexpr int FIRST_BAND_ROWS = 4;
constexpr int PILOT_FRAMES = 3;
constexpr int MORE_FRAMES = 4;

WorldOptions make_sky_band(int first_row, int end_row) {
    WorldOptions options;
    options.environment = Image(2, SKY_ROWS, 3);
    for (int y = first_row; y < end_row; ++y) {
        for (int i = 0; i < 6; ++i) options.environment->pixel(0, y)[i] = 1.0f;
    }
    return options;
}

struct Finish {
    float roughness;
    float metallic;
};

constexpr Finish FINISHES[] = {{0.0f, 0.0f}, {0.0f, 1.0f}, {0.2f, 0.0f}, {0.2f, 1.0f},
                               {0.5f, 0.0f}, {0.5f, 1.0f}, {1.0f, 0.0f}, {1.0f, 1.0f}};
constexpr int FINISH_COUNT = int(std::size(FINISHES));

// Stripes of all finishes, white, in one plane through the origin whose normal leans `angle_rad` from +Y
// towards +X.
ToyScene make_stripes(double angle_rad) {
    const glm::vec3 along(float(std::cos(angle_rad)), -float(std::sin(angle_rad)), 0.0f);
    ToyScene toy;
    for (int i = 0; i < FINISH_COUNT; ++i) {
        Material material;
        material.roughness = FINISHES[i].roughness;
        material.metallic = FINISHES[i].metallic;
        toy.add_quad(toy.add_material(material),
                     glm::vec3(0.0f, 0.0f, float(i) / FINISH_COUNT) - 20.0f * along,
                     {0.0f, 0.0f, 1.0f / FINISH_COUNT}, 40.0f * along);
    }
    return toy;
}

// Parallel rays that leave the plane towards +Y, the zenith of the sky.
CameraRecord look_at_stripes(const ToyRender& render, double angle_rad) {
    const glm::dvec3 view(std::sin(2.0 * angle_rad), std::cos(2.0 * angle_rad), 0.0), target(0.0, 0.0, 0.5);
    CameraRecord camera = render.look(target + 20.0 * view, target, 90.0);
    camera.orthographic = true;
    camera.right *= 0.5f;
    camera.up *= 0.5f;
    return camera;
}

// The stripes under one band of the sky.
struct Band {
    std::unique_ptr<ToyRender> render;
    int frames = 0;
    std::vector<RunningMoments> stripes;

    void add_frames(double angle_rad, int count) {
        add_instance_means(*render, look_at_stripes(*render, angle_rad), DirectMode::RIS, frames, count,
                           stripes);
        frames += count;
    }
};

struct Reflectance {
    double mean = 0.0;
    double variance = 0.0;  // of the mean
};

std::vector<Reflectance> sum_bands(const std::vector<Band>& bands) {
    std::vector<Reflectance> totals(FINISH_COUNT);
    for (const Band& band : bands) {
        for (int i = 0; i < FINISH_COUNT; ++i) {
            totals[i].mean += band.stripes[i].mean();
            totals[i].variance += band.stripes[i].variance_of_mean();
        }
    }
    return totals;
}

// Reflectance of each stripe at `angle_rad`. After `pilot_frames` of every band, more are spent where they
// help the worst stripe most, until all standard errors are below `error`.
std::vector<Reflectance> measure_stripes(double angle_rad, int pilot_frames, double error,
                                         const Defines& planted = {}) {
    std::vector<Band> bands;
    for (int first = 0, end = FIRST_BAND_ROWS; first < SKY_ROWS; first = end, end *= 2) {
        bands.emplace_back().render = std::make_unique<ToyRender>(
            make_stripes(angle_rad).scene, FURNACE_PX, FURNACE_PX, make_sky_band(first, end), planted);
        bands.back().add_frames(angle_rad, pilot_frames);
    }
    const auto by_variance = [](const Reflectance& a, const Reflectance& b) {
        return a.variance < b.variance;
    };
    for (;;) {
        const std::vector<Reflectance> totals = sum_bands(bands);
        const auto worst = std::max_element(totals.begin(), totals.end(), by_variance);
        if (std::sqrt(worst->variance) < error) return totals;
        const std::size_t i = std::size_t(worst - totals.begin());
        std::max_element(bands.begin(), bands.end(), [i](const Band& a, const Band& b) {
            return a.stripes[i].variance_of_mean() < b.stripes[i].variance_of_mean();
        })->add_frames(angle_rad, MORE_FRAMES);
    }
}

double find_brightest(const std::vector<Reflectance>& stripes) {
    double brightest = 0.0;
    for (const Reflectance& stripe : stripes) brightest = std::max(brightest, stripe.mean);
    return brightest;
}

TEST_F(GlClosedForms, WhiteDielectricsAndMetalsReflectAllThatArrives) {
    for (const double angle_deg : {0.0, 60.0, 75.0}) {
        const auto stripes = measure_stripes(angle_deg * DOUBLE_PI / 180.0, PILOT_FRAMES, FURNACE_ERROR);
        for (int i = 0; i < FINISH_COUNT; ++i) {
            const double error = std::sqrt(stripes[i].variance);
            std::printf("%.0f degrees, roughness %.1f, metallic %.0f: %.5f +- %.5f\n", angle_deg,
                        FINISHES[i].roughness, FINISHES[i].metallic, stripes[i].mean, error);
            EXPECT_LT(stripes[i].mean - 3.0 * error, 1.0 + FURNACE_TOLERANCE) << i;
            EXPECT_GT(stripes[i].mean + 3.0 * error, 1.0 - BRDF_TOLERANCE) << i;
        }
    }
}

TEST_F(GlClosedForms, ADroppedCosineShowsInAGgxFurnace) {
    EXPECT_GT(find_brightest(measure_stripes(DOUBLE_PI / 3.0, 2, 0.1, {"TARN_PLANT_DROP_COSINE"})), 1.1);
}

}  // namespace
}  // namespace tarn::test
