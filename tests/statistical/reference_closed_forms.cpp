// The reference against answers that are known: closed forms, and an independent quadrature in double
// precision.
#include <gtest/gtest.h>

#include <functional>

#include "support/brdf_oracle.h"
#include "support/reference_run.h"

namespace tarn {
namespace {

constexpr double DOUBLE_PI = 3.14159265358979323846;

using Integrand = std::function<glm::dvec3(const glm::dvec3& position_ws)>;

// What a camera sees of the plane y = `height_ws`, where every place sends `radiance(position)`.
Image expect_on_plane(const World& world, const ReferenceSettings& s, double height_ws,
                      const Integrand& radiance) {
    Image image(s.width, s.height, 3);
    for (int y = 0; y < s.height; ++y) {
        for (int x = 0; x < s.width; ++x) {
            const PreciseRay ray = pixel_ray(s, x, y);
            const glm::dvec3 origin_ws = ray.origin + world.origin_ws;
            const double t = (height_ws - origin_ws.y) / ray.direction.y;
            const glm::dvec3 value = radiance(origin_ws + ray.direction * t);
            for (int c = 0; c < 3; ++c) image.pixel(x, y)[c] = float(value[c]);
        }
    }
    return image;
}

Image constant_image(const ReferenceSettings& s, const glm::vec3& value) {
    Image image(s.width, s.height, 3);
    for (std::size_t i = 0; i < image.values.size(); ++i) image.values[i] = value[int(i % 3)];
    return image;
}

// ---- A point light over a plane
// -----------------------------------------------------------------------------------

double worst_relative_error(const Image& image, const Image& expected) {
    double worst = 0.0;
    for (std::size_t i = 0; i < image.values.size(); ++i) {
        worst = std::max(worst, std::abs(double(image.values[i]) / double(expected.values[i]) - 1.0));
    }
    return worst;
}

double point_over_plane_error(const glm::dvec3& offset_ws, PlantedBug bug) {
    const glm::dvec3 albedo(0.8, 0.5, 0.2), intensity(10.0, 20.0, 5.0),
        light_ws = offset_ws + glm::dvec3(0.3, 2, 0.1);
    ToyScene toy;
    const MeshIndex plane =
        toy.add_mesh(toy.add_material(lambert_material(albedo)),
                     {{-9, 0, -9}, {-9, 0, 9}, {9, 0, 9}, {-9, 0, -9}, {9, 0, 9}, {9, 0, -9}});
    toy.add_instance(plane, glm::translate(glm::dmat4(1.0), offset_ws));
    PunctualLight light;
    light.intensity = intensity;
    toy.add_light(light, glm::translate(glm::dmat4(1.0), light_ws));
    const World world = build_world(toy.scene);
    ReferenceSettings s =
        small_settings(world, offset_ws + glm::dvec3(0, 5, 4), offset_ws + glm::dvec3(0, 0, 0.2), 50.0);
    s.direct_only = true;
    s.spp = 2;
    s.planted_bug = bug;
    const Image expected = expect_on_plane(world, s, offset_ws.y, [&](const glm::dvec3& p) {
        const glm::dvec3 to_light = light_ws - p;
        const double distance = glm::length(to_light);
        return albedo / DOUBLE_PI * intensity * to_light.y / (distance * distance * distance);
    });
    return worst_relative_error(run_reference(world, s).radiance, expected);
}

TEST(ReferenceClosedForms, a_point_light_over_a_plane_within_1e_4) {
    EXPECT_LT(point_over_plane_error(glm::dvec3(0.0), PlantedBug::NONE), 1e-4);
}

TEST(ReferenceClosedForms, a_point_light_over_a_plane_far_from_the_origin) {
    EXPECT_LT(point_over_plane_error(glm::dvec3(1e3), PlantedBug::NONE), 1e-4);
    EXPECT_LT(point_over_plane_error(glm::dvec3(1e5, -1e5, 1e5), PlantedBug::NONE), 1e-4);
}

TEST(ReferenceClosedForms, a_dropped_cosine_shows_under_a_point_light) {
    EXPECT_GT(point_over_plane_error(glm::dvec3(0.0), PlantedBug::DROP_COSINE), 1e-2);
}

// ---- A rectangle over a plane
// -------------------------------------------------------------------------------------

constexpr glm::dvec3 RECTANGLE_ALBEDO{0.7, 0.6, 0.3};
constexpr glm::dvec3 RECTANGLE_RADIANCE{4.0, 2.0, 8.0};

// Radiance of a Lambert plane at `p` under the rectangle [-0.5, 0.5] x {1} x [-0.4, 0.4] that shines down, by
// the midpoint rule.
glm::dvec3 integrate_rectangle(const glm::dvec3& p) {
    constexpr int STEPS = 100;
    double sum = 0.0;
    for (int i = 0; i < STEPS; ++i) {
        for (int j = 0; j < STEPS; ++j) {
            const glm::dvec3 q(-0.5 + (i + 0.5) / STEPS, 1.0, -0.4 + 0.8 * (j + 0.5) / STEPS);
            const glm::dvec3 d = q - p;
            const double distance2 = glm::dot(d, d);
            sum += d.y * d.y / (distance2 * distance2);
        }
    }
    return RECTANGLE_ALBEDO / DOUBLE_PI * RECTANGLE_RADIANCE * (sum * 0.8 / (STEPS * STEPS));
}

// `mirrored`: the same rectangle, made by a mirroring transform of its mirror image.
World make_rectangle_world(bool mirrored) {
    ToyScene toy;
    toy.add_quad(toy.add_material(lambert_material(RECTANGLE_ALBEDO)), {-9, 0, -9}, {0, 0, 18}, {18, 0, 0});
    const MaterialIndex shining = toy.add_material(emissive_material(RECTANGLE_RADIANCE));
    const MeshIndex down = toy.add_mesh(shining, {{-0.5f, 1, -0.4f},
                                                  {0.5f, 1, -0.4f},
                                                  {0.5f, 1, 0.4f},
                                                  {-0.5f, 1, -0.4f},
                                                  {0.5f, 1, 0.4f},
                                                  {-0.5f, 1, 0.4f}});
    toy.add_instance(down, glm::scale(glm::dmat4(1.0), glm::dvec3(mirrored ? -1.0 : 1.0, 1.0, 1.0)));
    return build_world(toy.scene);
}

TileTest test_rectangle(LightStrategy strategy, PlantedBug bug, bool mirrored = false) {
    const World world = make_rectangle_world(mirrored);
    ReferenceSettings s = small_settings(world, {0, 0.9, 2.5}, {0, 0, 0}, 20.0);
    s.spp = 256;
    s.seed = 3;
    s.direct_only = true;
    s.strategy = strategy;
    s.planted_bug = bug;
    const Image expected = expect_on_plane(world, s, 0.0, integrate_rectangle);
    return compare_with_known(run_reference(world, s), expected, 1e-4);
}

TEST(ReferenceClosedForms, a_rectangle_over_a_plane_agrees_with_quadrature) {
    for (const auto strategy : {LightStrategy::MIS, LightStrategy::LIGHTS_ONLY, LightStrategy::BRDF_ONLY}) {
        const TileTest t = test_rectangle(strategy, PlantedBug::NONE);
        EXPECT_TRUE(t.passes) << int(strategy) << ": " << describe(t);
    }
}

TEST(ReferenceClosedForms, a_mirrored_rectangle_shines_from_the_same_side) {
    const TileTest t = test_rectangle(LightStrategy::MIS, PlantedBug::NONE, true);
    EXPECT_TRUE(t.passes) << describe(t);
}

TEST(ReferenceClosedForms, planted_bugs_show_under_a_rectangle) {
    for (const auto bug :
         {PlantedBug::DROP_COSINE, PlantedBug::DROP_LIGHT_PDF, PlantedBug::DOUBLE_COUNT_EMISSION}) {
        EXPECT_FALSE(test_rectangle(LightStrategy::MIS, bug).passes) << int(bug);
    }
}

TEST(ReferenceClosedForms, a_single_sided_emitter_is_dark_behind) {
    const World world = make_rectangle_world(false);
    ReferenceSettings s = small_settings(world, {0, 0.5, 0}, {0, 1, 0.001}, 30.0);
    s.spp = 1;
    s.bounces = 0;
    EXPECT_FLOAT_EQ(run_reference(world, s).radiance.pixel(16, 16)[2], 8.0f);
    // From above the camera passes through the emitter's back and sees the plane, which does not emit.
    s = small_settings(world, {0, 2.0, 0}, {0, 1, 0.001}, 10.0);
    s.spp = 1;
    s.bounces = 0;
    EXPECT_EQ(run_reference(world, s).radiance.pixel(16, 16)[2], 0.0f);
}

// ---- Even skies and furnaces
// --------------------------------------------------------------------------------------

TileTest test_sphere_in_even_sky(PlantedBug bug) {
    const glm::vec3 albedo(0.5f, 0.25f, 0.9f), sky(2.0f, 1.0f, 3.0f);
    ToyScene toy;
    toy.add_instance(toy.add_mesh(toy.add_material(lambert_material(albedo)), sphere_corners(1.0f, 24)));
    const World world = build_world(toy.scene, even_sky(sky));
    ReferenceSettings s = small_settings(world, {0, 0.5, 3}, {0, 0, 0}, 50.0);
    s.spp = 256;
    s.seed = 5;
    s.planted_bug = bug;
    const auto tracer = create_embree_tracer(world);
    Image expected(s.width, s.height, 3);
    for (int y = 0; y < s.height; ++y) {
        for (int x = 0; x < s.width; ++x) {
            const PixelRay through = camera_ray(s.camera, {x + 0.5f, y + 0.5f}, {s.width, s.height});
            const RayRecord ray{through.origin, RAY_INFINITY, through.direction, 0u};
            const glm::vec3 value = tracer->trace_closest(ray, {}) ? albedo * sky : sky;
            for (int c = 0; c < 3; ++c) expected.pixel(x, y)[c] = value[c];
        }
    }
    return compare_with_known(run_reference(world, s), expected);
}

TEST(ReferenceClosedForms, a_sphere_in_an_even_sky_reflects_its_albedo) {
    const TileTest t = test_sphere_in_even_sky(PlantedBug::NONE);
    EXPECT_TRUE(t.passes) << describe(t);
    EXPECT_FALSE(test_sphere_in_even_sky(PlantedBug::DROP_LIGHT_PDF).passes);
    EXPECT_FALSE(test_sphere_in_even_sky(PlantedBug::DOUBLE_COUNT_EMISSION).passes);
}

struct Furnace {
    double mean = 0.0;
    double standard_error = 0.0;
};

// Mean radiance of a plane in a sky of radiance 1, seen at `angle_deg` from its normal by parallel rays.
// `with_lamps`: two black lamps of radiance 1 hide parts of that sky, about where a mirror would show them.
Furnace measure_furnace(const Material& material, double angle_deg, ReferenceSettings s,
                        bool with_lamps = false) {
    ToyScene toy;
    toy.add_quad(toy.add_material(material), {-1, 0, -1}, {0, 0, 2}, {2, 0, 0});
    if (with_lamps) {
        const MaterialIndex lamp = toy.add_material(emissive_material(glm::vec3(1.0f)));
        toy.add_quad(lamp, {-2.0f, 1.8f, -1.0f}, {1.0f, 0, 0}, {0, 0, 2.0f});
        toy.add_quad(lamp, {-3.0f, 0.5f, 0.2f}, {0, 1.0f, 0}, {0, 0, 1.0f});
    }
    const World world = build_world(toy.scene, even_sky(glm::vec3(1.0f)));
    const double angle = angle_deg * DOUBLE_PI / 180.0;
    const auto camera =
        small_settings(world, glm::dvec3(std::sin(angle), std::cos(angle), 0.0), glm::dvec3(0.0), 1.0);
    s.width = camera.width;
    s.height = camera.height;
    s.camera = camera.camera;
    s.camera.orthographic = true;
    s.camera.right *= 0.1f;
    s.camera.up *= 0.1f;
    const ReferenceResult result = run_reference(world, s);
    Furnace furnace;
    double variance = 0.0;
    for (std::size_t i = 0; i < result.radiance.values.size(); i += 3) {
        furnace.mean += result.radiance.values[i];
        variance += result.variance.values[i];
    }
    const double pixels = double(result.radiance.pixel_count());
    furnace.mean /= pixels;
    furnace.standard_error = std::sqrt(variance) / pixels;
    return furnace;
}

ReferenceSettings furnace_settings(LightStrategy strategy, std::uint64_t spp) {
    ReferenceSettings s;
    s.strategy = strategy;
    s.spp = spp;
    return s;
}

TEST(ReferenceClosedForms, lambert_in_a_white_furnace_is_1_within_1e_3) {
    for (const double angle_deg : {0.0, 60.0, 88.0}) {
        const Furnace furnace = measure_furnace(lambert_material(glm::vec3(1.0f)), angle_deg,
                                                furnace_settings(LightStrategy::MIS, 1280));
        EXPECT_LT(furnace.standard_error, 2.5e-4);
        EXPECT_NEAR(furnace.mean, 1.0, 1e-3) << angle_deg;
    }
}

TEST(ReferenceClosedForms, white_dielectrics_and_metals_reflect_all_that_arrives) {
    for (const float roughness : {0.0f, 0.2f, 0.5f, 1.0f}) {
        for (const float metallic : {0.0f, 1.0f}) {
            for (const float ior : {1.5f, 2.5f}) {
                for (const double angle_deg : {0.0, 60.0, 88.0}) {
                    Material material;
                    material.roughness = roughness;
                    material.metallic = metallic;
                    material.ior = ior;
                    const Furnace furnace =
                        measure_furnace(material, angle_deg, furnace_settings(LightStrategy::BRDF_ONLY, 128));
                    ASSERT_LE(furnace.mean - 3.0 * furnace.standard_error, 1.0 + 1e-3)
                        << roughness << " " << metallic << " " << ior << " " << angle_deg;
                    ASSERT_GE(furnace.mean + 3.0 * furnace.standard_error, 1.0 - 1e-2)
                        << roughness << " " << metallic << " " << ior << " " << angle_deg;
                }
            }
        }
    }
}

// What a surface of these parameters reflects of radiance 1 from everywhere, by quadrature in double
// precision.
double integrate_reflectance(const Material& material, double angle_deg) {
    const double root = (material.ior - 1.0) / (material.ior + 1.0), metallic = material.metallic;
    const double f0 = root * root * (1.0 - metallic) + double(material.base_color.x) * metallic;
    const double albedo = double(material.base_color.x) * (1.0 - metallic);
    const double alpha = double(material.roughness) * material.roughness;
    const glm::dvec3 view = test::view_at(angle_deg);
    return test::integrate_hemisphere(
        [&](const glm::dvec3& l) {
            return test::oracle_brdf(albedo, f0, 1.0, alpha, view, l, test::shipped_albedos(alpha, view, l)) *
                   l.z;
        },
        view, alpha, 100'000);
}

// Lamps as bright as the sky that they hide change nothing; but how often each of the two is drawn, and what
// their weights are, must be right for that.
TEST(ReferenceClosedForms, lamps_as_bright_as_the_sky_behind_them_cannot_be_seen) {
    for (const float metallic : {0.0f, 1.0f}) {
        for (const double angle_deg : {20.0, 55.0}) {
            Material material;
            material.base_color = glm::vec4(glm::vec3(0.8f), 1.0f);
            material.metallic = metallic;
            material.roughness = 0.5f;
            const double expected = integrate_reflectance(material, angle_deg);
            const auto check = [&](LightStrategy strategy, bool light_tree) {
                ReferenceSettings s = furnace_settings(strategy, 256);
                s.light_tree = light_tree;
                const Furnace furnace = measure_furnace(material, angle_deg, s, true);
                // Lights alone rarely find the highlight.
                const double most = strategy == LightStrategy::LIGHTS_ONLY ? 2e-2 : 1e-3;
                EXPECT_LT(furnace.standard_error, most * expected);
                EXPECT_NEAR(furnace.mean, expected, 4.0 * furnace.standard_error + 2e-4)
                    << metallic << " " << angle_deg << " " << int(strategy) << " " << light_tree;
            };
            check(LightStrategy::MIS, false);
            check(LightStrategy::MIS, true);
            check(LightStrategy::LIGHTS_ONLY, true);
            check(LightStrategy::BRDF_ONLY, false);
        }
    }
}

// ---- Many bounces
// -------------------------------------------------------------------------------------------------

// Inside a closed box whose walls emit E and reflect rho, every place sends E (1 + rho + ... + rho^N) after N
// bounces.
TileTest test_closed_box(int bounces, LightStrategy strategy, PlantedBug bug) {
    const glm::vec3 emission(1.0f, 2.0f, 0.5f), albedo(0.8f, 0.5f, 0.2f);
    Material wall = lambert_material(albedo);
    wall.emission = emission;
    ToyScene toy;
    const MaterialIndex m = toy.add_material(wall);
    toy.add_quad(m, {-1, -1, -1}, {0, 0, 2}, {2, 0, 0});
    toy.add_quad(m, {-1, 1, -1}, {2, 0, 0}, {0, 0, 2});
    toy.add_quad(m, {-1, -1, -1}, {2, 0, 0}, {0, 2, 0});
    toy.add_quad(m, {-1, -1, 1}, {0, 2, 0}, {2, 0, 0});
    toy.add_quad(m, {-1, -1, -1}, {0, 2, 0}, {0, 0, 2});
    toy.add_quad(m, {1, -1, -1}, {0, 0, 2}, {0, 2, 0});
    const World world = build_world(toy.scene);
    ReferenceSettings s = small_settings(world, {-0.7, -0.2, -0.6}, {0.5, 0.1, 0.4}, 80.0);
    s.width = s.height = 16;
    s.spp = 512;
    s.seed = 9;
    s.bounces = bounces;
    s.strategy = strategy;
    s.planted_bug = bug;
    glm::vec3 expected(0.0f), term = emission;
    for (int i = 0; i <= bounces; ++i, term *= albedo) expected += term;
    return compare_with_known(run_reference(world, s), constant_image(s, expected));
}

TEST(ReferenceClosedForms, a_closed_glowing_box_sums_the_geometric_series) {
    for (const int bounces : {1, 8}) {
        for (const auto strategy : {LightStrategy::MIS, LightStrategy::BRDF_ONLY}) {
            const TileTest t = test_closed_box(bounces, strategy, PlantedBug::NONE);
            EXPECT_TRUE(t.passes) << bounces << " bounces: " << describe(t);
        }
    }
    EXPECT_FALSE(test_closed_box(8, LightStrategy::MIS, PlantedBug::DROP_COSINE).passes);
    EXPECT_FALSE(test_closed_box(8, LightStrategy::MIS, PlantedBug::DOUBLE_COUNT_EMISSION).passes);
}

}  // namespace
}  // namespace tarn
