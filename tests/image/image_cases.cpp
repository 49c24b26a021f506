#include "image/image_cases.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/display.h"
#include "core/error.h"
#include "core/log.h"
#include "reference/reference.h"
#include "renderer/renderer.h"
#include "support/test_scenes.h"

namespace tarn::test {
namespace {

constexpr std::uint64_t REFERENCE_SPP = 64;
// What moves in a scene moves by a thirtieth of a second a frame.
constexpr double FRAME_S = 1.0 / 30.0;

// Tolerances, for another processor, Mesa or Embree. Pictures are deterministic, so that noise needs no
// allowance; other rounding does. Measured: llvmpipe with SSE4.1, AVX and AVX-512, 128 and 256 bits wide, and
// Embree with SSE2 and AVX-512 gave the same bytes; so a camera moved by one unit in the last place, and by
// eight, stood in for other rounding.
//
// Greatest difference 2 of 255: rounding shifted values by 1, and a value on the border of two steps adds 1.
// Fraction: a pixel that chooses another light, loses its shadow ray or changes its triangle differs by
// anything up to 255. One unit moved 0.014 % of the pixels, eight moved 0.056 %, at worst (lantern_court,
// ris): 0.2 % is four times that.
constexpr ImageTolerance NOISY = {2, 0.002};
// Reuse spreads a changed sample to later frames and to neighbours: one unit moved 0.042 % of the pixels,
// eight moved 0.35 %, at worst. 1 % is three times that.
constexpr ImageTolerance RESAMPLED = {2, 0.01};
// One light and no shadow: nothing is chosen, and none of its pixels moved. 0.05 % are 7 pixels along the
// horizon.
constexpr ImageTolerance SMOOTH = {2, 0.0005};
// A pixel is the mean of 64 paths, of which one may go another way: rounding shifted values by 2 at most, 3
// allows for one more of the paths.
constexpr ImageTolerance PATH_TRACED = {3, 0.002};

std::vector<ImageSequence> list_sequences() {
    const std::vector<int> from_first_to_last = {1, 16, 64};
    std::vector<ImageSequence> list;
    const auto add = [&](const char* scene, const char* camera, float ev, const std::vector<int>& frames,
                         const ImageTolerance& tolerance) {
        for (const char* method : {"uniform", "ris"}) {
            list.push_back({scene, camera, method, ev, frames, tolerance});
        }
    };
    // Exposures, EV: lit surfaces lie in the middle of the range, where a change of a few per cent is seen.
    add("cornell", "main", 1.5f, from_first_to_last, NOISY);
    add("lantern_court", "main", 2.0f, from_first_to_last, NOISY);
    add("lantern_court", "closeup", 2.0f, from_first_to_last, NOISY);
    add("furnace_ggx", "main", -1.0f, {1}, NOISY);
    add("point_over_plane", "main", 0.0f, {1}, SMOOTH);
    add("rectangle_over_plane", "main", 2.0f, {1}, NOISY);
    add("many_lights", "main", 0.5f, {1}, NOISY);
    list.push_back({"cornell", "main", "reference", 1.5f, {1}, PATH_TRACED});
    for (const char* method : {"path", "restir_gi"}) {
        list.push_back({"cornell", "main", method, 1.5f, {1, 16}, RESAMPLED});
    }
    list.push_back({"lantern_court", "main", "clean", 2.0f, {1, 16}, RESAMPLED});
    for (const char* preset : {"balanced", "unbiased"}) {
        list.push_back({"lantern_court", "main", preset, 2.0f, from_first_to_last, RESAMPLED});
    }
    return list;
}

CameraRecord find_camera(const TestScene& scene, const std::string& name, double time_s) {
    const auto& cameras = scene.scene.cameras;
    const auto found = std::find_if(cameras.begin(), cameras.end(), [&](const Camera& c) {
        return c.name == name || at(scene.scene.nodes, c.node).name == name;
    });
    if (found == cameras.end()) throw Error("scene '{}' has no camera '{}'", scene.scene.name, name);
    const double aspect = double(GOLDEN_WIDTH_PX) / GOLDEN_HEIGHT_PX;
    return *scene_camera(scene.scene, scene.world, CameraIndex(std::size_t(found - cameras.begin())), aspect,
                         time_s);
}

// The settings of a preset, or the default ones with another mode.
RenderSettings settings_of(const std::string& method) {
    for (const Preset& preset : preset_table()) {
        if (preset.name == method) return preset.settings;
    }
    RenderSettings settings;
    settings.direct.mode = method == "uniform" ? DirectMode::UNIFORM : DirectMode::RIS;
    if (method == "path") settings.indirect.mode = IndirectMode::PATH;
    if (method == "restir_gi") settings.indirect.mode = IndirectMode::RESTIR;
    return settings;
}

Image render_reference_picture(const ImageSequence& sequence, const TestScene& scene) {
    ReferenceSettings settings;
    settings.width = GOLDEN_WIDTH_PX;
    settings.height = GOLDEN_HEIGHT_PX;
    settings.camera = find_camera(scene, sequence.camera, -1.0);
    settings.spp = REFERENCE_SPP;
    return render_reference(scene.world, *scene.tracer, settings).radiance;
}

}  // namespace

std::string ImageSequence::name() const {
    return fmt::format("{}_{}_{}", scene, camera, method);
}

std::string ImageSequence::golden_name(int frame) const {
    return is_reference() ? name() : fmt::format("{}_frame{}", name(), frame);
}

const std::vector<ImageSequence>& image_sequences() {
    static const std::vector<ImageSequence> list = list_sequences();
    return list;
}

std::filesystem::path golden_file(const std::string& golden_name) {
    return std::filesystem::path(TARN_SOURCE_DIR) / "tests" / "image" / "goldens" / (golden_name + ".png");
}

void render_sequence(const ImageSequence& sequence, const ImageSink& sink,
                     const std::vector<std::string>& planted) {
    set_quiet(true);
    const auto scene = load_test_scene(content_file(sequence.scene));
    if (sequence.is_reference()) {
        const Image radiance = render_reference_picture(sequence, *scene);
        sink(sequence.golden_name(1), display_from_radiance(radiance, sequence.exposure_ev));
        return;
    }
    Renderer renderer(scene->world, *scene->tracer, GOLDEN_WIDTH_PX, GOLDEN_HEIGHT_PX, planted);
    FrameInput input;
    input.settings = settings_of(sequence.method);
    for (int frame = 1; frame <= sequence.frames.back(); ++frame) {
        const double time_s = FRAME_S * (frame - 1);
        update_world(scene->world, scene->scene, time_s);
        scene->tracer->update(scene->world);
        renderer.update();
        input.camera = find_camera(*scene, sequence.camera, time_s);
        input.frame = std::uint32_t(frame - 1);
        const FrameOutput output = renderer.render(input);
        if (std::find(sequence.frames.begin(), sequence.frames.end(), frame) == sequence.frames.end())
            continue;
        sink(sequence.golden_name(frame),
             display_from_radiance(renderer.read_radiance(output.radiance), sequence.exposure_ev));
    }
}

}  // namespace tarn::test
