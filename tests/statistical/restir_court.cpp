// ReSTIR without bias in a scene of thousands of lights, in half a minute. restir.cpp compares single frames
// there and takes minutes (TARN_TEST_SEEDS); here a seed is the mean of several frames, and tiles are large.
#include "direct_light_case.h"
#include "metrics/frame_mean.h"
#include "support/on_context.h"

namespace tarn::test {
namespace {

constexpr int SEEDS = 24;
constexpr int SEEDS_TO_FIND_A_BUG = 12;
constexpr int WARM_UP_FRAMES = 4;
constexpr int FRAMES = 12;
constexpr int TILE_PX = 32;
constexpr std::uint64_t REFERENCE_SPP = 1024;
// What the test must be able to find, nine times in ten: the tests of small scenes find smaller biases.
constexpr double DETECTABLE_IN_PICTURE = 0.005;
constexpr double DETECTABLE_IN_TILE = 0.05;

struct Result {
    TileTest picture;  // as one tile
    TileTest tiles;
    bool passes() const { return picture.passes && tiles.passes; }
};

class RestirInTheCourt : public OnContext<> {
  protected:
    static void SetUpTestSuite() {
        OnContext::SetUpTestSuite();
        const double draws = double(find_preset("unbiased").settings.direct.candidates) * SEEDS * FRAMES;
        case_ = std::make_unique<DirectLightCase>("lantern_court", draws, REFERENCE_SPP);
    }
    static void TearDownTestSuite() {
        case_.reset();
        OnContext::TearDownTestSuite();
    }

    // A seed's picture is the mean of its frames after the warm-up: each of them has the reference's mean.
    static Result run(int seeds, const std::vector<std::string>& planted = {}) {
        TestScene& scene = case_->scene();
        Renderer renderer(scene.world, *scene.tracer, WIDTH_PX, HEIGHT_PX, planted);
        FrameInput input;
        input.camera = case_->camera();
        input.settings = find_preset("unbiased").settings;
        TileSamples picture(WIDTH_PX, HEIGHT_PX, WIDTH_PX), tiles(WIDTH_PX, HEIGHT_PX, TILE_PX);
        for (int seed = 0; seed < seeds; ++seed) {
            input.seed = std::uint32_t(seed) + 6000u;
            renderer.reset_history();
            FrameMean mean;
            for (int frame = 0; frame < FRAMES; ++frame) {
                input.frame = std::uint32_t(frame);
                const FrameOutput output = renderer.render(input);
                if (frame >= WARM_UP_FRAMES) mean.add(renderer.read_radiance(output.radiance));
            }
            Image image = mean.mean();
            case_->clear_left_out(image);
            picture.add(image);
            tiles.add(image);
        }
        const std::string what = planted.empty() ? "unbiased" : planted[0];
        return {case_->test(picture, what + ", picture"), case_->test(tiles, what + ", tiles")};
    }

    static inline std::unique_ptr<DirectLightCase> case_;
};

TEST_F(RestirInTheCourt, UnbiasedHasTheReferencesMean) {
    const Result result = run(SEEDS);
    EXPECT_TRUE(result.passes());
    EXPECT_LE(result.picture.detectable_bias, DETECTABLE_IN_PICTURE);
    EXPECT_LE(result.tiles.detectable_bias, DETECTABLE_IN_TILE);
}

TEST_F(RestirInTheCourt, ATargetOfTheNeighbourIsFound) {
    EXPECT_FALSE(run(SEEDS_TO_FIND_A_BUG, {"TARN_PLANT_TARGET_AT_NEIGHBOUR"}).passes());
}

}  // namespace
}  // namespace tarn::test
