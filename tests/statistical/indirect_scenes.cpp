// Indirect light without bias in scenes that nobody made for it: a court of thousands of lights, a Cornell
// box from elsewhere, a palace under an even sky. Frames 1 and 16 of the preset `unbiased`; TARN_TEST_SEEDS=N
// takes N seeds, and frame 64 as well.
#include "direct_light_case.h"

namespace tarn::test {
namespace {

bool is_thorough() {
    return std::getenv("TARN_TEST_SEEDS") != nullptr;
}
int seed_count() {
    return is_thorough() ? std::max(8, std::atoi(std::getenv("TARN_TEST_SEEDS"))) : 16;
}
// The first frame costs little and is the noisiest.
constexpr int FIRST_FRAME_SEEDS_FACTOR = 8;
// Frames that are compared, counted from 0.
constexpr int LATER_FRAMES[] = {15, 63};
constexpr int TILE_PX = 32;
constexpr std::uint64_t REFERENCE_SPP = 1024;
constexpr std::uint64_t THOROUGH_SPP = 16384;
// Relative bias of the picture's energy that frame 16 must be able to show, nine times in ten.
constexpr double DETECTABLE_IN_PICTURE = 0.03;

// A picture as one tile, and in tiles.
struct Samples {
    TileSamples picture{WIDTH_PX, HEIGHT_PX, WIDTH_PX};
    TileSamples tiles{WIDTH_PX, HEIGHT_PX, TILE_PX};

    void add(const Image& image) {
        picture.add(image);
        tiles.add(image);
    }
};

class IndirectScenes : public OnContext<testing::TestWithParam<const char*>> {
  protected:
    static void TearDownTestSuite() {
        case_.reset();
        OnContext::TearDownTestSuite();
    }

    void SetUp() override {
        const std::filesystem::path file = DirectLightCase::file_of(GetParam());
        if (!std::filesystem::exists(file)) GTEST_SKIP() << file.string() << " is not here";
        if (GetParam() == std::string("SponzaDabrovic") && !is_thorough())
            GTEST_SKIP() << "takes minutes; TARN_TEST_SEEDS=32 runs it";
        if (case_ && case_->name() == GetParam()) return;
        case_.reset();
        const double draws =
            double(unbiased_settings().direct.candidates) * FIRST_FRAME_SEEDS_FACTOR * seed_count();
        WorldOptions options;
        if (GetParam() == std::string("SponzaDabrovic")) options.environment = make_even_sky(1.0f);
        case_ = std::make_unique<DirectLightCase>(GetParam(), draws,
                                                  is_thorough() ? THOROUGH_SPP : REFERENCE_SPP, 2, options);
    }

    static RenderSettings unbiased_settings() {
        RenderSettings settings = find_preset("unbiased").settings;
        settings.indirect.mode = IndirectMode::RESTIR;
        return settings;
    }

    static Samples run(int seeds, int frame, const std::vector<std::string>& planted = {}) {
        TestScene& scene = case_->scene();
        Renderer renderer(scene.world, *scene.tracer, WIDTH_PX, HEIGHT_PX, planted);
        FrameInput input;
        input.camera = case_->camera();
        input.settings = unbiased_settings();
        Samples samples;
        for (int seed = 0; seed < seeds; ++seed) {
            input.seed = std::uint32_t(seed) + 7000u;
            renderer.reset_history();
            for (int i = 0; i <= frame; ++i) {
                input.frame = std::uint32_t(i);
                const FrameOutput output = renderer.render(input);
                if (i < frame) continue;
                Image image = renderer.read_radiance(output.radiance);
                case_->clear_left_out(image);
                samples.add(image);
            }
        }
        if (planted.empty()) {
            for (const auto& [name, value] : renderer.read_counters()) EXPECT_EQ(value, 0u) << name;
        }
        return samples;
    }

    // Both passed.
    static bool test(const Samples& samples, const std::string& what, double* detectable = nullptr) {
        const TileTest picture = case_->test(samples.picture, what + ", picture");
        const TileTest tiles = case_->test(samples.tiles, what + ", tiles");
        if (detectable != nullptr) *detectable = picture.detectable_bias;
        return picture.passes && tiles.passes;
    }

    static inline std::unique_ptr<DirectLightCase> case_;
};

TEST_P(IndirectScenes, FirstFramesHaveTheReferencesMean) {
    EXPECT_TRUE(test(run(FIRST_FRAME_SEEDS_FACTOR * seed_count(), 0), "frame 1"));
}

TEST_P(IndirectScenes, LaterFramesHaveTheReferencesMean) {
    for (const int frame : LATER_FRAMES) {
        if (frame != LATER_FRAMES[0] && !is_thorough()) continue;
        double detectable = 1.0;
        EXPECT_TRUE(test(run(seed_count(), frame), fmt::format("frame {}", frame + 1), &detectable));
        EXPECT_LE(detectable, DETECTABLE_IN_PICTURE);
    }
}

INSTANTIATE_TEST_SUITE_P(Scenes, IndirectScenes,
                         testing::Values("lantern_court", "CornellBox-bevy", "SponzaDabrovic"),
                         [](const auto& info) {
                             std::string name = info.param;
                             std::erase(name, '-');
                             return name;
                         });

}  // namespace
}  // namespace tarn::test
