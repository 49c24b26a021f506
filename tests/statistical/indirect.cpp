// Indirect light meets the reference with as many bounces: paths as they are, and path samples reused over
// time and neighbours in frame 1, 16 and 64 and under a moving camera. Mistakes of the reconnection are
// found.
#include <cmath>
#include <map>

#include "core/statistics.h"
#include "direct_light_case.h"
#include "metrics/frame_mean.h"
#include "shared/math/colour.h"

namespace tarn::test {
namespace {

constexpr int SEEDS = 16;
constexpr int FIRST_FRAME_SEEDS = 96;
constexpr int MOVING_FRAMES = 12;
constexpr int COARSE_SEEDS = 32;
constexpr std::uint64_t REFERENCE_SPP = 1024;  // about a tenth of the variance: most is the samples'
// What a test must be able to find in a tile, nine times in ten.
constexpr double DETECTABLE = 0.03;

RenderSettings make_settings(IndirectMode mode, int bounces = 1) {
    RenderSettings settings;
    settings.direct.mode = DirectMode::RIS;
    settings.direct.candidates = 16;
    settings.indirect.mode = mode;
    settings.indirect.bounces = bounces;
    settings.indirect.candidates = 4;  // fewer seeds
    settings.indirect.reuse.mis_visibility = true;
    settings.indirect.reuse.radius_px = 10.0;  // of a small picture
    return settings;
}

RenderSettings unbiased(Mis mis, int bounces = 1) {
    RenderSettings settings = make_settings(IndirectMode::RESTIR, bounces);
    settings.indirect.reuse.mis = mis;
    return settings;
}

class Indirect : public OnContext<> {
  protected:
    static void TearDownTestSuite() {
        cases_.clear();
        under_sky_.reset();
        OnContext::TearDownTestSuite();
    }

    // The box, with the light of so many surfaces before the one that is seen.
    static DirectLightCase& find_case(int bounces) {
        std::unique_ptr<DirectLightCase>& found = cases_[bounces];
        if (!found) found = std::make_unique<DirectLightCase>("cornell", 1.0, REFERENCE_SPP, bounces + 1);
        return *found;
    }

    // The same in an even sky, which lights it through its open front.
    static DirectLightCase& find_case_under_sky() {
        WorldOptions options;
        options.environment = make_even_sky(3.0f);
        if (!under_sky_)
            under_sky_ = std::make_unique<DirectLightCase>("cornell", 1.0, REFERENCE_SPP, 2, options);
        return *under_sky_;
    }

    static CameraRecord move_camera(DirectLightCase& box, int frames_before) {
        CameraRecord camera = box.camera();
        const float step = 0.002f * float(glm::length(box.scene().world.bounds.extent()));
        camera.position -= (glm::normalize(camera.right) + camera.forward) * (step * float(frames_before));
        return camera;
    }

    // Frame `frame`, counted from 0, of `seeds` runs.
    static TileTest run(const RenderSettings& settings, const std::string& what, int frame, int seeds,
                        const std::vector<std::string>& planted = {}, bool moves = false) {
        return run(find_case(settings.indirect.bounces), settings, what, frame, seeds, planted, moves);
    }

    static TileTest run(DirectLightCase& box, const RenderSettings& settings, const std::string& what,
                        int frame, int seeds, const std::vector<std::string>& planted = {},
                        bool moves = false) {
        Renderer renderer(box.scene().world, *box.scene().tracer, WIDTH_PX, HEIGHT_PX, planted);
        FrameInput input;
        input.settings = settings;
        input.camera = box.camera();
        TileSamples samples(WIDTH_PX, HEIGHT_PX, DirectLightCase::tile_px("cornell"));
        const int first_averaged = moves ? frame : frame + 1 - averaged_frames(frame);
        for (int seed = 0; seed < seeds; ++seed) {
            input.seed = std::uint32_t(seed) + 8000u;
            renderer.reset_history();
            FrameMean mean;
            for (int i = 0; i <= frame; ++i) {
                input.frame = std::uint32_t(i);
                if (moves) input.camera = move_camera(box, frame - i);
                const FrameOutput output = renderer.render(input);
                if (i < first_averaged) continue;
                mean.add(renderer.read_radiance(output.radiance));
            }
            Image image = mean.mean();
            box.clear_left_out(image);
            samples.add(image);
            if (!planted.empty() && box.stands_out(samples)) break;
        }
        if (planted.empty()) expect_silence(renderer, settings, seeds * (frame + 1));
        return box.test(samples, fmt::format("{}, frame {}", what, frame + 1));
    }

    // 1/Z asks again whether a pixel sees its own sample. A path that ended on an edge may be traced past it
    // then: such a sample is lost, and counted. No more than one in 100 000.
    static void expect_silence(const Renderer& renderer, const RenderSettings& settings, int frames) {
        const bool asks_again = settings.indirect.reuse.mis == Mis::ONE_OVER_Z;
        const double samples = double(frames) * WIDTH_PX * HEIGHT_PX;
        for (const auto& [name, value] : renderer.read_counters()) {
            const bool may_be = asks_again && name == "bad_reservoirs";
            EXPECT_LE(double(value), may_be ? 1e-5 * samples : 0.0) << name;
        }
    }

    static void expect_pass(const TileTest& test, const std::string& what) {
        EXPECT_TRUE(test.passes) << what;
        EXPECT_LE(test.detectable_bias, DETECTABLE) << what;
    }

    static inline std::map<int, std::unique_ptr<DirectLightCase>> cases_;
    static inline std::unique_ptr<DirectLightCase> under_sky_;
};

TEST_F(Indirect, PathsHaveTheReferencesMeanHoweverTheyAreDrawn) {
    for (const IndirectSampling sampling :
         {IndirectSampling::UNIFORM, IndirectSampling::COSINE, IndirectSampling::BRDF}) {
        for (const NoiseKind noise : {NoiseKind::WHITE, NoiseKind::BLUE}) {
            RenderSettings settings = make_settings(IndirectMode::PATH);
            settings.indirect.sampling = sampling;
            settings.indirect.noise = noise;
            const std::string what = fmt::format("path, sampling {}, noise {}", int(sampling), int(noise));
            expect_pass(run(settings, what, 0, FIRST_FRAME_SEEDS), what);
        }
    }
}

RenderSettings looking_for_lamps(PathLights lights, double light_rays) {
    RenderSettings settings = make_settings(IndirectMode::PATH);
    settings.indirect.lights = lights;
    settings.indirect.light_rays = light_rays;
    return settings;
}

TEST_F(Indirect, PathsHaveTheReferencesMeanHoweverTheyFindLamps) {
    for (const auto& [lights, rays] : {std::pair(PathLights::POWER, 0.0), std::pair(PathLights::TREE, 0.0),
                                       std::pair(PathLights::TREE, 1.0)}) {
        const std::string what = fmt::format("path, lights {}, rays {}", int(lights), rays);
        expect_pass(run(looking_for_lamps(lights, rays), what, 0, FIRST_FRAME_SEEDS), what);
    }
}

TEST_F(Indirect, LampsAndSkyAreSharedByCandidatesAndRays) {
    for (const PathLights lights : {PathLights::POWER, PathLights::TREE}) {
        RenderSettings settings = looking_for_lamps(lights, 0.25);
        settings.direct.candidates = 64;  // the sky makes direct light noisy
        const std::string what = fmt::format("under a sky, lights {}", int(lights));
        expect_pass(run(find_case_under_sky(), settings, what, 0, 5 * FIRST_FRAME_SEEDS), what);
    }
}

TEST_F(Indirect, PathsOfSeveralBouncesHaveTheReferencesMean) {
    for (const int bounces : {2, 4}) {
        const std::string what = fmt::format("path, {} bounces", bounces);
        expect_pass(run(make_settings(IndirectMode::PATH, bounces), what, 0, FIRST_FRAME_SEEDS), what);
    }
}

TEST_F(Indirect, ReusedSamplesHaveTheReferencesMeanWhateverTheWeights) {
    for (const Mis mis : {Mis::ONE_OVER_Z, Mis::BALANCE, Mis::PAIRWISE}) {
        const std::string what = fmt::format("restir, mis {}", int(mis));
        expect_pass(run(unbiased(mis), what, 0, FIRST_FRAME_SEEDS), what);
        // Pairwise has the shortest tails, 1/Z the longest.
        const int seeds = mis == Mis::PAIRWISE ? SEEDS : mis == Mis::BALANCE ? 2 * SEEDS : 7 * SEEDS;
        expect_pass(run(unbiased(mis), what, 15, seeds), what);
    }
}

TEST_F(Indirect, ReusedSamplesKeepTheReferencesMeanForManyFrames) {
    expect_pass(run(unbiased(Mis::PAIRWISE), "restir, pairwise", 63, SEEDS), "pairwise");
}

TEST_F(Indirect, AllSamplesOfAStepTogetherHaveTheReferencesMean) {
    RenderSettings settings = unbiased(Mis::BALANCE);
    settings.indirect.reuse.shade = SampleShading::ALL;
    expect_pass(run(settings, "restir, shade all", 7, 6 * SEEDS), "shade all");
}

TEST_F(Indirect, ReusedSamplesOfSeveralBouncesHaveTheReferencesMean) {
    for (const int bounces : {2, 4}) {
        const std::string what = fmt::format("restir, {} bounces", bounces);
        expect_pass(run(unbiased(Mis::PAIRWISE, bounces), what, 15, SEEDS), what);
    }
}

TEST_F(Indirect, AMovingCameraKeepsTheReferencesMean) {
    expect_pass(run(unbiased(Mis::PAIRWISE), "restir, moving", MOVING_FRAMES - 1, 3 * SEEDS, {}, true),
                "moving");
}

TEST_F(Indirect, MisWeightsSumToOneInEveryPixel) {
    DirectLightCase& box = find_case(1);
    for (const Mis mis : {Mis::BALANCE, Mis::PAIRWISE}) {
        Renderer renderer(box.scene().world, *box.scene().tracer, WIDTH_PX, HEIGHT_PX, {"TARN_CHECK_MIS"});
        FrameInput input;
        input.settings = unbiased(mis);
        for (input.frame = 0; input.frame < 3; ++input.frame) {
            input.camera = move_camera(box, 3 - int(input.frame));
            renderer.render(input);
        }
        EXPECT_EQ(renderer.read_counters().at("mis_sums"), 0u) << "mis " << int(mis);
    }
}

// ---- Coarse pictures

// Mean luminance of a picture.
double find_energy(const Image& image) {
    const glm::dvec3 weights(LUMINANCE_WEIGHTS);
    double sum = 0.0;
    for (std::size_t i = 0; i < image.values.size(); ++i) {
        sum += weights[int(i % 3)] * image.values[i];
    }
    return sum / double(image.values.size() / 3);
}

// Energy over the reference's, seed by seed, each over as many frames as every pixel needs to have its turn.
RunningMoments find_energy_ratio(DirectLightCase& box, const RenderSettings& settings,
                                 const std::vector<std::string>& planted = {}) {
    constexpr int FRAMES = 16;
    const double expected = find_energy(box.reference());
    Renderer renderer(box.scene().world, *box.scene().tracer, WIDTH_PX, HEIGHT_PX, planted);
    FrameInput input;
    input.settings = settings;
    input.camera = box.camera();
    RunningMoments ratios;
    for (int seed = 0; seed < COARSE_SEEDS; ++seed) {
        double sum = 0.0;
        input.seed = std::uint32_t(seed) + 9000u;
        renderer.reset_history();
        for (input.frame = 0; input.frame < FRAMES; ++input.frame) {
            Image image = renderer.read_radiance(renderer.render(input).radiance);
            box.clear_left_out(image);
            sum += find_energy(image);
        }
        ratios.add(sum / (FRAMES * expected));
    }
    for (const auto& [name, value] : renderer.read_counters()) {
        if (name != "coarse_gaps") {
            EXPECT_EQ(value, 0u) << name;
        }
    }
    return ratios;
}

TEST_F(Indirect, CoarsePicturesKeepTheReferencesEnergy) {
    for (const IndirectMode mode : {IndirectMode::PATH, IndirectMode::RESTIR}) {
        for (const IndirectResolution resolution : {IndirectResolution::HALF, IndirectResolution::QUARTER}) {
            RenderSettings settings = make_settings(mode);
            settings.indirect.resolution = resolution;
            const RunningMoments ratio = find_energy_ratio(find_case(1), settings);
            const double error = std::sqrt(ratio.variance_of_mean());
            const std::string what =
                fmt::format("mode {}, resolution {}: {:.4f} of the energy, standard error {:.4f}", int(mode),
                            int(resolution), ratio.mean(), error);
            fmt::print("{}\n", what);
            EXPECT_NEAR(ratio.mean(), 1.0, 0.01) << what;
            EXPECT_LE(error, 0.01 / 3.0) << what;  // or chance alone could decide
        }
    }
}

// ---- Planted bugs

TEST_F(Indirect, MistakesOfTheReconnectionAreFound) {
    for (const char* bug : {"TARN_PLANT_DROP_RECONNECTION_JACOBIAN", "TARN_PLANT_CLAMP_RECONNECTION_JACOBIAN",
                            "TARN_PLANT_TARGET_AT_NEIGHBOUR"}) {
        for (const Mis mis : {Mis::BALANCE, Mis::PAIRWISE}) {
            // The subtlest one takes more seeds to stand out.
            const bool is_subtle = bug == std::string("TARN_PLANT_DROP_RECONNECTION_JACOBIAN");
            const TileTest test = run(unbiased(mis), fmt::format("{} {}", bug, int(mis)), 7,
                                      is_subtle ? 2 * SEEDS : 3 * SEEDS / 2, {bug});
            EXPECT_FALSE(test.passes) << bug << " with mis " << int(mis);
        }
    }
}

TEST_F(Indirect, LampsThatCandidatesAndRaysDoNotShareAreFound) {
    const RenderSettings settings = looking_for_lamps(PathLights::TREE, 0.25);
    for (const char* bug : {"TARN_PLANT_FORGET_LIGHT_PDF", "TARN_PLANT_FORGET_RAY_SHARE"}) {
        const TileTest test = run(find_case_under_sky(), settings, bug, 0, FIRST_FRAME_SEEDS, {bug});
        EXPECT_FALSE(test.passes) << bug;
    }
}

TEST_F(Indirect, EmissionThatCountsTwiceIsFound) {
    const char* bug = "TARN_PLANT_COUNT_EMISSION";
    EXPECT_FALSE(run(make_settings(IndirectMode::PATH, 2), bug, 0, FIRST_FRAME_SEEDS, {bug}).passes);
}

TEST_F(Indirect, LightOfACoarsePictureThatIsNotNormalisedIsFound) {
    RenderSettings settings = make_settings(IndirectMode::PATH);
    settings.indirect.resolution = IndirectResolution::QUARTER;
    const char* bug = "TARN_PLANT_DROP_UPSAMPLE_NORMALIZATION";
    EXPECT_LT(find_energy_ratio(find_case(1), settings, {bug}).mean(), 0.99);
}

}  // namespace
}  // namespace tarn::test
