// The preset `clean` keeps the energy that it promises, at rest and walking: direct and indirect light,
// denoised, against the reference of as many bounces.
//
// Lamps in view would outshine all else: pixels that emit are left out, and so are those far above the mean
// in either picture, which the noise of few samples decides.
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
constexpr int SEEDS = 12;
constexpr int FRAMES = 24;
constexpr float STEP_M = 0.02f;     // a frame: 1.2 m/s at 60 frames a second
constexpr double FAR_ABOVE = 20.0;  // the reference's mean
constexpr double MOST_LEFT_OUT = 0.02;
constexpr double MOST_ERROR =
    0.03;  // standard error of the energy: at rest samples stay, and so do rare bright ones
constexpr std::uint64_t REFERENCE_SPP = 1024;

using Luminances = std::vector<double>;

Luminances luminance_of(const Image& image) {
    Luminances result;
    for (std::size_t i = 0; i < image.values.size(); i += 3) {
        result.push_back(luminance(glm::vec3(image.values[i], image.values[i + 1], image.values[i + 2])));
    }
    return result;
}

class CleanPreset : public OnContext<testing::TestWithParam<const char*>> {
  protected:
    CameraRecord camera_at(int frame, float step_m) const {
        CameraRecord camera = first_camera(*scene_, double(WIDTH_PX) / HEIGHT_PX);
        camera.position += glm::normalize(camera.right) * (step_m * float(frame - (FRAMES - 1)));
        return camera;
    }

    // The last frame; `emits` gets which pixels do.
    Luminances render(float step_m, std::uint32_t seed, std::vector<bool>& emits) const {
        Renderer renderer(scene_->world, *scene_->tracer, WIDTH_PX, HEIGHT_PX);
        FrameInput input;
        input.settings = find_preset("clean").settings;
        input.seed = seed;
        Luminances last;
        for (int frame = 0; frame < FRAMES; ++frame) {
            input.frame = std::uint32_t(frame);
            input.camera = camera_at(frame, step_m);
            const FrameOutput output = renderer.render(input);
            if (frame + 1 < FRAMES) continue;
            last = luminance_of(renderer.read_radiance(output.radiance));
            emits.clear();
            for (const glm::vec4& texel :
                 output.gbuffer.surfaces->layers[LAYER_EMISSION].download<glm::vec4>()) {
                emits.push_back(texel.x + texel.y + texel.z > 0.0f);
            }
        }
        return last;
    }

    Luminances render_truth() const {
        ReferenceSettings settings;
        settings.width = WIDTH_PX;
        settings.height = HEIGHT_PX;
        settings.camera = camera_at(FRAMES - 1, 0.0f);
        settings.bounces = 2;
        settings.spp = REFERENCE_SPP;
        return luminance_of(render_reference(scene_->world, *scene_->tracer, settings).radiance);
    }

    std::unique_ptr<TestScene> scene_ = load_test_scene(content_file(GetParam()));
};

TEST_P(CleanPreset, KeepsTheEnergyItPromisesAtRestAndWalking) {
    const Preset& preset = find_preset("clean");
    const Luminances truth = render_truth();
    for (const float step_m : {0.0f, STEP_M}) {
        std::vector<Luminances> pictures;
        std::vector<bool> is_out;
        for (std::uint32_t seed = 0; seed < SEEDS; ++seed) pictures.push_back(render(step_m, seed, is_out));
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
        double expected = 0.0;
        for (std::size_t i = 0; i < truth.size(); ++i) expected += is_out[i] ? 0.0 : truth[i];
        RunningMoments energy;
        for (const Luminances& picture : pictures) {
            double sum = 0.0;
            for (std::size_t i = 0; i < picture.size(); ++i) sum += is_out[i] ? 0.0 : picture[i];
            energy.add(sum / expected);
        }
        const double error = std::sqrt(energy.variance_of_mean());
        fmt::print("{}, {} m a frame: energy {:.4f}, standard error {:.4f}, {} pixels left out\n", GetParam(),
                   step_m, energy.mean(), error, left_out);
        EXPECT_NEAR(energy.mean(), 1.0, preset.energy_bound) << step_m;
        EXPECT_LE(error, MOST_ERROR) << step_m;
        EXPECT_LE(left_out, MOST_LEFT_OUT * double(truth.size())) << step_m;
    }
}

INSTANTIATE_TEST_SUITE_P(Scenes, CleanPreset, testing::Values("cornell", "lantern_court"),
                         [](const auto& info) { return std::string(info.param); });

}  // namespace
}  // namespace tarn::test
