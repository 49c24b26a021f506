// A sky beside lamps: every way to find a light, with the BRDF's candidate and without, for each channel and
// for all, has the reference's mean, and none of them lets a whole frame see the sky alone or not at all.
#include "core/statistics.h"
#include "motion_run.h"
#include "support/indirect_scenes.h"

namespace tarn::test {
namespace {

class SkyAndLights : public MotionTest {};

MotionMethod single(const std::string& name, DirectMode mode) {
    RenderSettings settings;
    settings.direct.mode = mode;
    settings.direct.samples = mode == DirectMode::UNIFORM ? 80 : 64;
    return {name, [settings](int) { return settings; }};
}

MotionMethod ris(const std::string& name, LightSelection selection, bool brdf_candidate) {
    RenderSettings settings;
    settings.direct.mode = DirectMode::RIS;
    settings.direct.light_selection = selection;
    settings.direct.brdf_candidate = brdf_candidate;
    // A quarter of them is no whole number. Few beside the BRDF's, so that its share of the light is large.
    settings.direct.candidates = brdf_candidate ? 3 : 14;
    settings.direct.samples = brdf_candidate || selection == LightSelection::UNIFORM ? 16 : 8;
    return {name, [settings](int) { return settings; }};
}

TEST_F(SkyAndLights, OneCandidateASampleHasNoBias) {
    expect_no_bias(make_lamps_under_a_sky(),
                   {single("uniform", DirectMode::UNIFORM), single("power", DirectMode::POWER),
                    single("light-tree", DirectMode::LIGHT_TREE)},
                   2 * SEEDS);
}

TEST_F(SkyAndLights, RisHasNoBias) {
    expect_no_bias(
        make_lamps_under_a_sky(),
        {ris("uniform", LightSelection::UNIFORM, false), ris("power", LightSelection::POWER, false),
         ris("tiles", LightSelection::TILES, false), ris("tree", LightSelection::TREE, false),
         ris("uniform, brdf", LightSelection::UNIFORM, true), ris("power, brdf", LightSelection::POWER, true),
         ris("tiles, brdf", LightSelection::TILES, true), ris("tree, brdf", LightSelection::TREE, true)});
}

TEST_F(SkyAndLights, RestirHasNoBias) {
    const auto select = [](LightSelection selection, bool brdf_candidate) {
        return [=](RenderSettings& settings) {
            settings.direct.light_selection = selection;
            settings.direct.brdf_candidate = brdf_candidate;
            if (selection == LightSelection::TREE) settings.direct.candidates = 8;
        };
    };
    expect_no_bias(make_lamps_under_a_sky(),
                   {unbiased("tree, brdf", Mis::PAIRWISE, select(LightSelection::TREE, true)),
                    unbiased("uniform", Mis::PAIRWISE, select(LightSelection::UNIFORM, false)),
                    unbiased("tiles, brdf, per channel", Mis::PAIRWISE,
                             [](RenderSettings& settings) { settings.direct.per_channel = true; })},
                   SEEDS);
    expect_within_bounds(make_lamps_under_a_sky());
}

TEST_F(SkyAndLights, NegativeControlTheSkysShareForgottenByTheBrdfsCandidateIsFound) {
    expect_found(make_lamps_under_a_sky(), ris("power, brdf", LightSelection::POWER, true),
                 "TARN_PLANT_FORGET_SKY_SHARE");
}

// The floor is glossy: what it sends to the ball depends on where the ball is.
MotionMethod indirect(const std::string& name, IndirectMode mode) {
    MotionMethod method = ris(name, LightSelection::POWER, true);
    RenderSettings settings = method.settings(0);
    settings.indirect.mode = mode;
    settings.indirect.reuse.mis_visibility = true;
    settings.indirect.reuse.radius_px = 10.0;
    method.settings = [settings](int) { return settings; };
    return method;
}

TEST_F(SkyAndLights, IndirectLightHasNoBias) {
    expect_no_bias(make_lamps_under_a_sky(),
                   {indirect("path", IndirectMode::PATH), indirect("restir-gi", IndirectMode::RESTIR)},
                   2 * SEEDS);
}

TEST_F(SkyAndLights, NegativeControlTheSkysShareForgottenWherePathsMeetSurfacesIsFound) {
    MotionMethod method = indirect("path", IndirectMode::PATH);
    // Rays would find part of what is missing.
    method.settings = [whole = method.settings](int frame) {
        RenderSettings settings = whole(frame);
        settings.indirect.light_rays = 0.0;
        return settings;
    };
    expect_found(make_lamps_under_a_sky(), method, "TARN_PLANT_FORGET_SKY_SHARE_OF_PATHS");
}

// Candidates and rays share lamps that places see from close by.
MotionMethod path_with_rays(const std::string& name, PathLights lights, double light_rays) {
    MotionMethod method = indirect(name, IndirectMode::PATH);
    RenderSettings settings = method.settings(0);
    settings.indirect.lights = lights;
    settings.indirect.light_rays = light_rays;
    method.settings = [settings](int) { return settings; };
    return method;
}

// All light is that of single paths, and noisy: the tests see 3 % of the picture. The mistakes below are 8
// and 37 %.
TEST_F(SkyAndLights, LampsCloseToWhatTheyLightAreCountedOnce) {
    expect_no_bias(make_lamps_close_to_the_ceiling(),
                   {path_with_rays("tree", PathLights::TREE, 1.0),
                    path_with_rays("tree, some rays", PathLights::TREE, 0.25),
                    path_with_rays("power", PathLights::POWER, 1.0)},
                   4 * SEEDS, {0.03, 0.2});
}

TEST_F(SkyAndLights, NegativeControlDensitiesThatCandidatesDoNotHaveAreFound) {
    for (const char* bug : {"TARN_PLANT_AREA_OF_NEAR_LIGHTS", "TARN_PLANT_OTHER_NORMAL"})
        expect_found(make_lamps_close_to_the_ceiling(), path_with_rays("tree", PathLights::TREE, 1.0), bug);
}

// Rays along the BRDF end on a lamp that is half there half of the time.
TEST_F(SkyAndLights, LampsOfPartialCoverageAreCountedOnce) {
    const MotionMethod method = ris("power, brdf", LightSelection::POWER, true);
    expect_no_bias(make_half_lamps(), {method, ris("tree, brdf", LightSelection::TREE, true)}, 2 * SEEDS);
    expect_found(make_half_lamps(), method, "TARN_PLANT_FORGET_COVERAGE");
}

// Relative deviation of a frame's energy.
double frame_deviation(DirectMode mode, const std::vector<std::string>& planted) {
    MovingScene still = make_lamps_under_a_sky();
    World world = build_world(still.scene, still.options);
    const auto tracer = create_embree_tracer(world);
    Renderer renderer(world, *tracer, WIDTH_PX, HEIGHT_PX, planted);
    FrameInput input;
    input.camera = look_at(world, still.camera_ws, still.target_ws, 45.0, double(WIDTH_PX) / HEIGHT_PX);
    input.settings.direct.mode = mode;
    RunningMoments energy;
    for (input.frame = 0; input.frame < 64; ++input.frame) {
        const Image image = renderer.read_radiance(renderer.render(input).radiance);
        double sum = 0.0;
        for (const float value : image.values) sum += value;
        energy.add(sum);
    }
    return std::sqrt(energy.variance()) / energy.mean();
}

TEST_F(SkyAndLights, AFrameIsNeitherAllSkyNorNone) {
    for (const DirectMode mode : {DirectMode::POWER, DirectMode::LIGHT_TREE}) {
        EXPECT_LT(frame_deviation(mode, {}), 0.1);
        EXPECT_GT(frame_deviation(mode, {"TARN_PLANT_SKY_PER_FRAME"}), 0.5);
    }
}

}  // namespace
}  // namespace tarn::test
