// The reference against itself: sampling strategies agree, threads and bounces do not change what they must
// not, and coverage, unlit surfaces and broken samples do what they say.
#include <gtest/gtest.h>

#include <limits>

#include "core/error.h"
#include "core/statistics.h"
#include "support/light_scenes.h"
#include "support/reference_run.h"

namespace tarn {
namespace {

// A Cornell-like box: red and green walls, a light in the ceiling, a glossy block and a point light.
World make_box_world() {
    ToyScene toy;
    const MaterialIndex white = toy.add_material(lambert_material(glm::vec3(0.7f)));
    const MaterialIndex red = toy.add_material(lambert_material({0.6f, 0.05f, 0.05f}));
    const MaterialIndex green = toy.add_material(lambert_material({0.1f, 0.5f, 0.1f}));
    const MaterialIndex light = toy.add_material(emissive_material({12.0f, 10.0f, 7.0f}));
    Material glossy;
    glossy.base_color = {0.9f, 0.7f, 0.4f, 1.0f};
    glossy.roughness = 0.4f;
    glossy.metallic = 0.7f;
    toy.add_quad(white, {-1, -1, -1}, {0, 0, 2}, {2, 0, 0});
    toy.add_quad(white, {-1, 1, -1}, {2, 0, 0}, {0, 0, 2});
    toy.add_quad(white, {-1, -1, -1}, {2, 0, 0}, {0, 2, 0});
    toy.add_quad(red, {-1, -1, -1}, {0, 2, 0}, {0, 0, 2});
    toy.add_quad(green, {1, -1, -1}, {0, 0, 2}, {0, 2, 0});
    toy.add_quad(light, {-0.3f, 0.99f, -0.3f}, {0.6f, 0, 0}, {0, 0, 0.6f});
    const MeshIndex ball = toy.add_mesh(toy.add_material(glossy), sphere_corners(0.4f, 12));
    toy.add_instance(ball, glm::translate(glm::dmat4(1.0), glm::dvec3(0.3, -0.6, 0.1)));
    PunctualLight point;
    point.intensity = {0.3f, 0.3f, 0.6f};
    toy.add_light(point, glm::translate(glm::dmat4(1.0), glm::dvec3(-0.6, 0.2, 0.5)));
    return build_world(toy.scene);
}

ReferenceSettings box_settings(const World& world) {
    ReferenceSettings s = small_settings(world, {0, 0, 3.2}, {0, 0, 0}, 42.0);
    s.spp = 256;
    return s;
}

ReferenceResult render_box(const World& world, LightStrategy strategy, PlantedBug bug, std::uint32_t seed) {
    ReferenceSettings s = box_settings(world);
    s.strategy = strategy;
    s.planted_bug = bug;
    s.seed = seed;
    return run_reference(world, s);
}

// Means over tiles of 8 pixels, each tile of 64 pixels x 256 samples.
TEST(ReferenceStrategies, mis_agrees_with_light_sampling_alone_and_with_brdf_sampling_alone) {
    const World world = make_box_world();
    const ReferenceResult mis = render_box(world, LightStrategy::MIS, PlantedBug::NONE, 1);
    const TileTest lights =
        compare_images(render_box(world, LightStrategy::LIGHTS_ONLY, PlantedBug::NONE, 2), mis);
    EXPECT_TRUE(lights.passes) << describe(lights);
    const TileTest brdf =
        compare_images(render_box(world, LightStrategy::BRDF_ONLY, PlantedBug::NONE, 3), mis);
    EXPECT_TRUE(brdf.passes) << describe(brdf);
    for (const auto bug :
         {PlantedBug::DROP_COSINE, PlantedBug::DROP_LIGHT_PDF, PlantedBug::DOUBLE_COUNT_EMISSION}) {
        const ReferenceResult wrong = render_box(world, LightStrategy::MIS, bug, 4);
        EXPECT_FALSE(compare_images(wrong, mis).passes) << int(bug);
    }
}

// A floor under a glowing veil: emission through partial coverage.
ReferenceResult render_glowing_veil(AlphaMode mode, float alpha, LightStrategy strategy, std::uint32_t seed) {
    ToyScene toy;
    Material veil = emissive_material({5.0f, 4.0f, 3.0f});
    veil.double_sided = true;
    veil.alpha_mode = mode;
    veil.base_color.w = alpha;
    toy.add_quad(toy.add_material(lambert_material(glm::vec3(0.5f))), {-2, 0, -2}, {0, 0, 4}, {4, 0, 0});
    toy.add_quad(toy.add_material(veil), {-1, 1, -1}, {0, 0, 2}, {2, 0, 0});
    const World world = build_world(toy.scene);
    ReferenceSettings s = small_settings(world, {0, 0.8, 0.5}, {0, 0, 0}, 40.0);
    s.spp = 1024;
    s.direct_only = true;
    s.strategy = strategy;
    s.seed = seed;
    return run_reference(world, s);
}

TEST(ReferenceStrategies, a_glowing_veil_lights_as_much_as_it_covers_for_every_strategy) {
    const ReferenceResult whole = render_glowing_veil(AlphaMode::OPAQUE, 1.0f, LightStrategy::MIS, 1);
    for (const auto strategy : {LightStrategy::LIGHTS_ONLY, LightStrategy::BRDF_ONLY, LightStrategy::MIS}) {
        const ReferenceResult brdf = render_glowing_veil(AlphaMode::BLEND, 0.4f, LightStrategy::BRDF_ONLY, 2);
        const TileTest veil = compare_images(render_glowing_veil(AlphaMode::BLEND, 0.4f, strategy, 3), brdf);
        EXPECT_TRUE(veil.passes) << int(strategy) << ": " << describe(veil);
        const TileTest kept = compare_images(render_glowing_veil(AlphaMode::MASK, 0.6f, strategy, 4), whole);
        EXPECT_TRUE(kept.passes) << int(strategy) << ": " << describe(kept);
        EXPECT_EQ(render_glowing_veil(AlphaMode::MASK, 0.4f, strategy, 5).radiance.pixel(16, 16)[0], 0.0f);
    }
    const ReferenceResult veil = render_glowing_veil(AlphaMode::BLEND, 0.4f, LightStrategy::MIS, 6);
    EXPECT_FALSE(compare_images(veil, whole).passes);
}

// A room with many lamps of all kinds: both ways to draw a light have the same mean, the tree's with less
// noise.
TEST(ReferenceStrategies, lights_drawn_by_the_tree_light_as_much_as_by_power) {
    test::LightScene lights(5);
    lights.add_lights(200, true);
    lights.toy().add_quad(lights.toy().add_material(lambert_material(glm::vec3(0.5f))), {-6, -2, -6},
                          {0, 0, 12}, {12, 0, 0});
    const World world = build_world(lights.scene());
    ReferenceSettings s = small_settings(world, {0, 2, 6}, {0, -1, 0}, 60.0);
    s.spp = 2048;
    s.direct_only = true;
    const ReferenceResult by_power = run_reference(world, s);
    s.light_tree = true;
    s.seed = 1;
    const ReferenceResult by_tree = run_reference(world, s);
    const TileTest test = compare_images(by_tree, by_power);
    EXPECT_TRUE(test.passes) << describe(test);
    EXPECT_LT(by_tree.relative_error, by_power.relative_error);
    s.planted_bug = PlantedBug::DROP_LIGHT_PDF;
    EXPECT_FALSE(compare_images(run_reference(world, s), by_power).passes);
}

TEST(ReferenceStrategies, one_seed_gives_the_same_bits_for_any_number_of_threads) {
    const World world = make_box_world();
    ReferenceSettings s = box_settings(world);
    s.width = 50;
    s.height = 37;
    s.spp = 11;
    s.box_pixel_filter = true;
    ReferenceResult results[2];
    for (int threads = 1; threads <= 2; ++threads) {
        const WorkerLimit limit(threads);
        results[threads - 1] = run_reference(world, s);
    }
    EXPECT_EQ(results[0].radiance.values, results[1].radiance.values);
    EXPECT_EQ(results[0].variance.values, results[1].variance.values);
    EXPECT_EQ(results[0].rays, results[1].rays);
    s.seed = 1;
    EXPECT_NE(run_reference(world, s).radiance.values, results[0].radiance.values);
}

// Half the squared difference of two seeds estimates the variance of the mean without any theory. Rare bright
// samples spread the estimate widely, so its own spread over the pairs decides.
TEST(ReferenceStrategies, the_reported_variance_is_that_of_the_mean) {
    const World world = make_box_world();
    ReferenceSettings s = box_settings(world);
    s.spp = 32;
    RunningMoments reported, excess;
    for (std::uint32_t pair = 0; pair < 24; ++pair) {
        s.seed = 2 * pair;
        const ReferenceResult a = run_reference(world, s);
        s.seed = 2 * pair + 1;
        const ReferenceResult b = run_reference(world, s);
        double reported_sum = 0.0, seen_sum = 0.0;
        for (std::size_t i = 0; i < a.radiance.values.size(); ++i) {
            const double difference = double(a.radiance.values[i]) - double(b.radiance.values[i]);
            seen_sum += 0.5 * difference * difference;
            reported_sum += 0.5 * (double(a.variance.values[i]) + double(b.variance.values[i]));
        }
        reported.add(reported_sum);
        excess.add(reported_sum - seen_sum);
    }
    const double standard_error = std::sqrt(excess.variance_of_mean());
    EXPECT_LT(standard_error, 0.25 * reported.mean());
    EXPECT_LT(std::abs(excess.mean()), 3.5 * standard_error);
}

TEST(ReferenceStrategies, direct_only_is_one_bounce) {
    const World world = make_box_world();
    ReferenceSettings s = box_settings(world);
    s.spp = 4;
    s.direct_only = true;
    const ReferenceResult direct = run_reference(world, s);
    s.direct_only = false;
    s.bounces = 1;
    EXPECT_EQ(run_reference(world, s).radiance.values, direct.radiance.values);
}

TEST(ReferenceStrategies, the_relative_error_target_ends_the_work) {
    const World world = make_box_world();
    ReferenceSettings s = box_settings(world);
    s.spp = 4096;
    s.relative_error = 0.2;
    const ReferenceResult result = run_reference(world, s);
    EXPECT_LT(result.relative_error, 0.2);
    EXPECT_LT(result.spp, 4096u);
}

TEST(ReferenceStrategies, cancelling_keeps_what_is_there) {
    const World world = make_box_world();
    ReferenceSettings s = box_settings(world);
    const std::atomic<bool> cancel{true};
    s.cancel = &cancel;
    const ReferenceResult result = run_reference(world, s);
    EXPECT_TRUE(result.cancelled);
    EXPECT_GT(result.spp, 0u);
    EXPECT_LT(result.spp, s.spp);
    EXPECT_GT(result.radiance.pixel(16, 24)[0], 0.0f);
}

// ---- Coverage, unlit surfaces, broken samples
// ---------------------------------------------------------------------

// A floor under a point light, and between them whatever the test hangs there.
ReferenceResult render_under(const Material& hanging) {
    ToyScene toy;
    toy.add_quad(toy.add_material(lambert_material(glm::vec3(0.5f))), {-2, 0, -2}, {0, 0, 4}, {4, 0, 0});
    toy.add_quad(toy.add_material(hanging), {-9, 1, -9}, {0, 0, 18}, {18, 0, 0});
    PunctualLight light;
    light.intensity = glm::vec3(10.0f);
    toy.add_light(light, glm::translate(glm::dmat4(1.0), glm::dvec3(0, 2, 0)));
    const World world = build_world(toy.scene);
    ReferenceSettings s = small_settings(world, {0, 0.8, 0.5}, {0, 0, 0}, 40.0);
    s.spp = 512;
    s.direct_only = true;
    return run_reference(world, s);
}

TEST(ReferenceStrategies, a_surface_of_opacity_0_3_lets_0_7_of_the_light_through) {
    Material veil = lambert_material(glm::vec3(0.0f));
    veil.double_sided = true;
    veil.alpha_mode = AlphaMode::BLEND;
    veil.base_color.w = 0.0f;
    const ReferenceResult open = render_under(veil);
    veil.base_color.w = 0.3f;
    Image expected = open.radiance;
    for (float& value : expected.values) value *= 0.7f;
    const TileTest t = compare_with_known(render_under(veil), expected);
    EXPECT_TRUE(t.passes) << describe(t);
    EXPECT_FALSE(compare_with_known(render_under(veil), open.radiance).passes);
}

TEST(ReferenceStrategies, masked_surfaces_block_all_or_nothing) {
    Material mask = lambert_material(glm::vec3(0.0f));
    mask.double_sided = true;
    mask.alpha_mode = AlphaMode::MASK;
    mask.base_color.w = 0.4f;
    EXPECT_GT(render_under(mask).radiance.pixel(16, 16)[0], 0.1f);
    mask.base_color.w = 0.6f;
    EXPECT_EQ(render_under(mask).radiance.pixel(16, 16)[0], 0.0f);
}

TEST(ReferenceStrategies, unlit_surfaces_show_their_colour_to_the_camera_alone) {
    Material unlit;
    unlit.unlit = true;
    unlit.double_sided = true;
    unlit.base_color = {0.25f, 0.5f, 0.75f, 1.0f};
    ToyScene toy;
    toy.add_quad(toy.add_material(unlit), {-1, 0, -1}, {0, 0, 2}, {2, 0, 0});
    const World alone = build_world(toy.scene, even_sky(glm::vec3(3.0f)));
    ReferenceSettings s = small_settings(alone, {0, 1, 0.1}, {0, 0, 0}, 40.0);
    s.spp = 4;
    EXPECT_FLOAT_EQ(run_reference(alone, s).radiance.pixel(16, 16)[1], 0.5f);

    // A floor that sees nothing but an unlit dome's inside gets no light from it, and none of the sky behind
    // it.
    const MeshIndex dome =
        toy.add_mesh(at(toy.scene.meshes, MeshIndex(0)).material, sphere_corners(8.0f, 12));
    toy.add_instance(dome);
    toy.add_quad(toy.add_material(lambert_material(glm::vec3(1.0f))), {-1, 1, -1}, {0, 0, 2}, {2, 0, 0});
    const World inside = build_world(toy.scene, even_sky(glm::vec3(3.0f)));
    s = small_settings(inside, {0, 2, 0.1}, {0, 1, 0}, 40.0);
    s.spp = 64;
    EXPECT_EQ(run_reference(inside, s).radiance.pixel(16, 16)[1], 0.0f);
}

TEST(ReferenceStrategies, samples_that_are_not_finite_are_counted_and_left_out) {
    ToyScene toy;
    Material broken = emissive_material(glm::vec3(1.0f));
    broken.emission.x = std::numeric_limits<float>::infinity();
    toy.add_quad(toy.add_material(broken), {-9, 0, -9}, {0, 0, 18}, {18, 0, 0});
    const World world = build_world(toy.scene);
    ReferenceSettings s = small_settings(world, {0, 1, 0.1}, {0, 0, 0}, 40.0);
    s.spp = 3;
    const ReferenceResult result = run_reference(world, s);
    EXPECT_EQ(result.non_finite, 3u * result.radiance.pixel_count());
    EXPECT_EQ(result.radiance.pixel(16, 16)[0], 0.0f);
}

TEST(ReferenceStrategies, settings_out_of_range_are_errors) {
    const World world = make_box_world();
    ReferenceSettings s = box_settings(world);
    s.spp = 0;
    EXPECT_THROW(run_reference(world, s), Error);
    s = box_settings(world);
    s.bounces = MAX_BOUNCES + 1;
    EXPECT_THROW(run_reference(world, s), Error);
    s = box_settings(world);
    s.height = 0;
    EXPECT_THROW(run_reference(world, s), Error);
}

}  // namespace
}  // namespace tarn
