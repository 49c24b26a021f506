// What the biased presets make of indirect light: its energy, apart from direct light's, and pixels that stay
// black without cause, in two scenes and at the resolution that each preset has.
//
// Paths at full resolution without reuse are the truth: tests/statistical/indirect.cpp holds them against the
// reference, which would be the noisier one here. The part of a picture is its difference from the same
// frames without indirect light, whose direct light is the same to the bit. A path that ends close to a
// seldom drawn lamp makes its pixel so bright that one of 5000 decides the energy: pixels far above the mean,
// in any of the pictures, are left out of all, and more light candidates than the presets have lower the
// noise. Neither touches what presets differ in.
#include <cmath>
#include <map>

#include "core/statistics.h"
#include "metrics/frame_mean.h"
#include "renderer/renderer.h"
#include "shared/math/colour.h"
#include "support/on_context.h"
#include "support/test_scenes.h"

namespace tarn::test {
namespace {

constexpr int WIDTH_PX = 96;
constexpr int HEIGHT_PX = 54;
constexpr int SEEDS = 12;
constexpr std::uint32_t FIRST_SEED = 100;
constexpr int FRAMES = 40;
constexpr int CANDIDATES = 8;
constexpr double FAR_ABOVE = 50.0;       // the picture's mean
constexpr double MOST_LEFT_OUT = 0.005;  // of all pixels
constexpr double ENERGY_BOUND = 0.05;
constexpr double MOST_ERROR = 0.02;   // standard error of the energy
constexpr double MOST_BLACK = 0.001;  // of all pixels
constexpr double SURELY_LIT = 0.05;   // of the picture's mean

using Picture = std::vector<double>;  // luminance a pixel

Picture luminance_of(const Image& image) {
    const glm::dvec3 weights(LUMINANCE_WEIGHTS);
    Picture result(image.values.size() / 3);
    for (std::size_t i = 0; i < image.values.size(); ++i) {
        result[i / 3] += weights[int(i % 3)] * double(image.values[i]);
    }
    return result;
}

double mean_of(const Picture& picture) {
    double sum = 0.0;
    for (const double value : picture) sum += value;
    return sum / double(picture.size());
}

// Indirect light of each seed, as the mean of its frames.
struct IndirectPart {
    std::vector<Picture> seeds;

    Picture pooled() const {
        Picture sum(seeds[0].size());
        for (const Picture& seed : seeds) {
            for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += seed[i] / double(seeds.size());
        }
        return sum;
    }
};

class IndirectPresets : public OnContext<testing::TestWithParam<const char*>> {
  protected:
    static RenderSettings settings_of(const IndirectSettings& indirect) {
        RenderSettings settings;
        settings.direct.mode = DirectMode::UNIFORM;  // it is taken away again
        settings.indirect = indirect;
        settings.indirect.candidates = CANDIDATES;
        return settings;
    }

    Picture render_mean(const RenderSettings& settings, std::uint32_t seed) {
        Renderer renderer(scene_->world, *scene_->tracer, WIDTH_PX, HEIGHT_PX);
        FrameInput input;
        input.camera = first_camera(*scene_, double(WIDTH_PX) / HEIGHT_PX);
        input.settings = settings;
        input.seed = seed;
        FrameMean mean;
        for (input.frame = 0; input.frame < FRAMES; ++input.frame) {
            mean.add(renderer.read_radiance(renderer.render(input).radiance));
        }
        return luminance_of(mean.mean());
    }

    // The same seeds for all parts, so that direct light is drawn once. Errors are summed as if parts were
    // independent: what they have in common makes them smaller.
    IndirectPart render_part(const IndirectSettings& indirect) {
        IndirectPart part;
        for (std::uint32_t seed = FIRST_SEED; seed < FIRST_SEED + SEEDS; ++seed) {
            Picture with = render_mean(settings_of(indirect), seed);
            const Picture& without = find_direct(seed);
            for (std::size_t i = 0; i < with.size(); ++i) with[i] -= without[i];
            part.seeds.push_back(std::move(with));
        }
        return part;
    }

    const Picture& find_direct(std::uint32_t seed) {
        const auto found = direct_.find(seed);
        if (found != direct_.end()) return found->second;
        return direct_[seed] = render_mean(settings_of({}), seed);
    }

    static IndirectSettings truth_settings() {
        IndirectSettings indirect;
        indirect.mode = IndirectMode::PATH;
        indirect.light_rays = 1.0;
        return indirect;
    }

    std::unique_ptr<TestScene> scene_ = load_test_scene(content_file(GetParam()));
    std::map<std::uint32_t, Picture> direct_;  // by seed
};

// Blackens pixels far above the mean in any of the pictures, in all of them.
void leave_out_fireflies(std::vector<IndirectPart>& parts) {
    std::vector<bool> is_out(parts[0].seeds[0].size());
    for (const IndirectPart& part : parts) {
        const Picture pooled = part.pooled();
        const double limit = FAR_ABOVE * mean_of(pooled);
        for (std::size_t i = 0; i < pooled.size(); ++i) is_out[i] = is_out[i] || pooled[i] > limit;
    }
    const auto count = std::count(is_out.begin(), is_out.end(), true);
    fmt::print("{} of {} pixels left out\n", count, is_out.size());
    EXPECT_LE(double(count), MOST_LEFT_OUT * double(is_out.size()));
    for (IndirectPart& part : parts) {
        for (Picture& seed : part.seeds) {
            for (std::size_t i = 0; i < seed.size(); ++i) seed[i] = is_out[i] ? 0.0 : seed[i];
        }
    }
}

RunningMoments energies_of(const IndirectPart& part) {
    RunningMoments moments;
    for (const Picture& seed : part.seeds) moments.add(mean_of(seed));
    return moments;
}

std::size_t count_black(const IndirectPart& part, const IndirectPart& truth) {
    const Picture shown = part.pooled(), expected = truth.pooled();
    const double lit = SURELY_LIT * mean_of(expected);
    std::size_t black = 0;
    for (std::size_t i = 0; i < shown.size(); ++i) black += expected[i] > lit && shown[i] <= 0.0 ? 1 : 0;
    return black;
}

TEST_P(IndirectPresets, KeepTheEnergyAndLeaveNoPixelBlack) {
    std::vector<IndirectPart> parts = {render_part(truth_settings())};
    const std::vector<std::string> names = {"fast",
                                            "balanced"};  // `fine` has the indirect light of `balanced`
    for (const std::string& name : names) {
        IndirectSettings indirect = find_preset(name).settings.indirect;
        indirect.mode = IndirectMode::RESTIR;
        parts.push_back(render_part(indirect));
    }
    leave_out_fireflies(parts);
    const RunningMoments truth = energies_of(parts[0]);
    for (std::size_t k = 0; k < names.size(); ++k) {
        const RunningMoments energy = energies_of(parts[k + 1]);
        const double ratio = energy.mean() / truth.mean();
        const double error =
            std::sqrt(energy.variance_of_mean() + ratio * ratio * truth.variance_of_mean()) / truth.mean();
        const std::size_t black = count_black(parts[k + 1], parts[0]);
        fmt::print("{}, {}: {:.4f} of the energy of indirect light, standard error {:.4f}, {} black pixels\n",
                   GetParam(), names[k], ratio, error, black);
        EXPECT_NEAR(ratio, 1.0, ENERGY_BOUND) << names[k];
        EXPECT_LE(error, MOST_ERROR) << names[k];
        EXPECT_LE(double(black), MOST_BLACK * WIDTH_PX * HEIGHT_PX) << names[k];
    }
}

INSTANTIATE_TEST_SUITE_P(Scenes, IndirectPresets, testing::Values("cornell", "lantern_court"),
                         [](const auto& info) { return std::string(info.param); });

}  // namespace
}  // namespace tarn::test
