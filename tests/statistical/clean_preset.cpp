// The preset `clean` keeps the energy that it promises, at rest and walking: direct and indirect light,
// denoised, against the reference of as many bounces.
//
// The whole picture, of which lamps in view are the most; and without them: pixels that they touch are left
// out, with those whose past is read from them in motion, and those far above the mean in either picture,
// which the noise of few samples decides.
#include <cmath>

#include "core/statistics.h"
#include "reference/reference.h"
#include "renderer/renderer.h"
#include "shared/math/colour.h"
#include "support/on_context.h"
#include "support/test_scenes.h"

namespace tarn::test {
namespace {

constexpr int WIDTH_PX = 96;
constexpr int HEIGHT_PX = 54;
constexpr int SEEDS = 8;
constexpr int FRAMES = 24;
constexpr std::uint32_t PLACES = 64;  // in a pixel (find_jitter)
constexpr float STEP_M = 0.02f;       // a frame: 1.2 m/s at 60 frames a second
constexpr double FAR_ABOVE = 20.0;    // the reference's mean
constexpr double MOST_LEFT_OUT = 0.02;
constexpr double MOST_ERROR =
    0.03;  // standard error of the energy: at rest samples stay, and so do rare bright ones
constexpr std::uint64_t REFERENCE_SPP = 1024;
constexpr std::uint64_t EMISSION_SPP = 64;
constexpr int LAMP_REACH_PX = 2;

using Luminances = std::vector<double>;

Luminances luminance_of(const Image& image) {
    Luminances result;
    for (std::size_t i = 0; i < image.values.size(); i += 3) {
        result.push_back(luminance(glm::vec3(image.values[i], image.values[i + 1], image.values[i + 2])));
    }
    return result;
}

// Over the truth's, each picture a sample.
RunningMoments find_energy(const std::vector<Luminances>& pictures, const Luminances& truth,
                           const std::vector<bool>& is_out) {
    double expected = 0.0;
    for (std::size_t i = 0; i < truth.size(); ++i) expected += is_out[i] ? 0.0 : truth[i];
    RunningMoments energy;
    for (const Luminances& picture : pictures) {
        double sum = 0.0;
        for (std::size_t i = 0; i < picture.size(); ++i) sum += is_out[i] ? 0.0 : picture[i];
        energy.add(sum / expected);
    }
    return energy;
}

class CleanPreset : public OnContext<testing::TestWithParam<const char*>> {
  protected:
    CameraRecord camera_at(int frame, float step_m) const {
        CameraRecord camera = first_camera(*scene_, double(WIDTH_PX) / HEIGHT_PX);
        camera.position += glm::normalize(camera.right) * (step_m * float(frame - (FRAMES - 1)));
        return camera;
    }

    // The last frame. Seeds end in the first frames of a turn through the places in a pixel, which are even
    // over it: what lamps emit beyond white is a single sample in motion.
    Luminances render(float step_m, std::uint32_t seed) const {
        Renderer renderer(scene_->world, *scene_->tracer, WIDTH_PX, HEIGHT_PX);
        FrameInput input;
        input.settings = find_preset("clean").settings;
        input.seed = seed;
        Luminances last;
        for (int frame = 0; frame < FRAMES; ++frame) {
            input.frame = PLACES + seed - (FRAMES - 1) + std::uint32_t(frame);
            input.camera = camera_at(frame, step_m);
            const FrameOutput output = renderer.render(input);
            if (frame + 1 == FRAMES) last = luminance_of(renderer.read_radiance(output.radiance));
        }
        return last;
    }

    Luminances render_truth(int bounces, std::uint64_t spp) const {
        ReferenceSettings settings;
        settings.width = WIDTH_PX;
        settings.height = HEIGHT_PX;
        settings.camera = camera_at(FRAMES - 1, 0.0f);
        settings.bounces = bounces;
        settings.spp = spp;
        settings.box_pixel_filter = find_preset("clean").settings.antialias.joins_frames();
        return luminance_of(render_reference(scene_->world, *scene_->tracer, settings).radiance);
    }

    // Pixels that lamps touch, and those around.
    std::vector<bool> find_lamps() const {
        const Luminances emission = render_truth(0, EMISSION_SPP);
        std::vector<bool> result(emission.size());
        for (int y = 0; y < HEIGHT_PX; ++y) {
            for (int x = 0; x < WIDTH_PX; ++x) {
                if (emission[std::size_t(y * WIDTH_PX + x)] == 0.0) continue;
                for (int v = std::max(0, y - LAMP_REACH_PX); v <= std::min(HEIGHT_PX - 1, y + LAMP_REACH_PX);
                     ++v) {
                    for (int u = std::max(0, x - LAMP_REACH_PX);
                         u <= std::min(WIDTH_PX - 1, x + LAMP_REACH_PX); ++u)
                        result[std::size_t(v * WIDTH_PX + u)] = true;
                }
            }
        }
        return result;
    }

    std::unique_ptr<TestScene> scene_ = load_test_scene(content_file(GetParam()));
};

TEST_P(CleanPreset, KeepsTheEnergyItPromisesAtRestAndWalking) {
    const Preset& preset = find_preset("clean");
    const Luminances truth = render_truth(2, REFERENCE_SPP);
    const std::vector<bool> lamps = find_lamps();
    for (const float step_m : {0.0f, STEP_M}) {
        std::vector<Luminances> pictures;
        std::vector<bool> is_out = lamps;
        for (std::uint32_t seed = 0; seed < SEEDS; ++seed) pictures.push_back(render(step_m, seed));
        double mean = 0.0;
        for (std::size_t i = 0; i < truth.size(); ++i)
            mean += is_out[i] ? 0.0 : truth[i] / double(truth.size());
        int left_out = 0;
        const auto is_far = [&](double value) { return value > FAR_ABOVE * mean; };
        for (std::size_t i = 0; i < truth.size(); ++i) {
            bool far = is_far(truth[i]);
            for (const Luminances& picture : pictures) far = far || is_far(picture[i]);
            if (!is_out[i] && far) ++left_out;
            is_out[i] = is_out[i] || far;
        }
        const RunningMoments energy = find_energy(pictures, truth, is_out);
        const RunningMoments whole = find_energy(pictures, truth, std::vector<bool>(truth.size(), false));
        const double error = std::sqrt(energy.variance_of_mean());
        fmt::print(
            "{}, {} m a frame: energy {:.4f}, standard error {:.4f}, {} pixels left out; with lamps {:.4f} "
            "+- {:.4f}\n",
            GetParam(), step_m, energy.mean(), error, left_out, whole.mean(),
            std::sqrt(whole.variance_of_mean()));
        EXPECT_NEAR(whole.mean(), 1.0, preset.energy_bound) << step_m;
        EXPECT_NEAR(energy.mean(), 1.0, preset.energy_bound) << step_m;
        EXPECT_LE(error, MOST_ERROR) << step_m;
        EXPECT_LE(left_out, MOST_LEFT_OUT * double(truth.size())) << step_m;
    }
}

INSTANTIATE_TEST_SUITE_P(Scenes, CleanPreset, testing::Values("cornell", "lantern_court"),
                         [](const auto& info) { return std::string(info.param); });

}  // namespace
}  // namespace tarn::test
