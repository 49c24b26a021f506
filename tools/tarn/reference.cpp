// tarn reference: path-traced radiance of a scene, with the variance of every pixel.
#include "reference/reference.h"

#include <fmt/format.h>

#include <memory>
#include <nlohmann/json.hpp>

#include "commands.h"
#include "core/error.h"
#include "core/version.h"
#include "image_io/image_io.h"
#include "interrupt.h"
#include "output/output_files.h"
#include "scene_options.h"

namespace tarn {
namespace {

struct ReferenceOptions {
    SceneOptions scene;
    ReferenceSettings settings;
    std::filesystem::path out;
    std::filesystem::path json;
    std::string pixel = "centre";
};

std::vector<float> take_channel(const Image& image, int channel) {
    std::vector<float> values(image.pixel_count());
    for (std::size_t i = 0; i < values.size(); ++i) {
        values[i] = image.values[i * std::size_t(image.channels) + std::size_t(channel)];
    }
    return values;
}

void write_picture(const std::filesystem::path& path, const ReferenceResult& result, std::uint32_t seed) {
    const Image &mean = result.radiance, &variance = result.variance;
    write_exr(
        path, mean.width, mean.height,
        {{"R", take_channel(mean, 0)},
         {"G", take_channel(mean, 1)},
         {"B", take_channel(mean, 2)},
         {"variance.R", take_channel(variance, 0)},
         {"variance.G", take_channel(variance, 1)},
         {"variance.B", take_channel(variance, 2)}},
        {{"software", describe_program()}, {"tarn.run", fmt::format("seed={} spp={}", seed, result.spp)}});
}

void write_report(const ReferenceOptions& options, const ReferenceResult& result) {
    const ReferenceSettings& s = options.settings;
    nlohmann::ordered_json json;
    json["spp"] = result.spp;
    json["relative_error"] = result.relative_error;
    json["non_finite"] = result.non_finite;
    json["rays"] = result.rays;
    json["seconds"] = result.seconds;
    json["cancelled"] = result.cancelled;
    json["settings"] = {{"scene", options.scene.scene.string()},
                        {"width", s.width},
                        {"height", s.height},
                        {"camera", options.scene.camera},
                        {"time_s", options.scene.time_s},
                        {"seed", s.seed},
                        {"bounces", s.direct_only ? 1 : s.bounces},
                        {"direct_only", s.direct_only},
                        {"light_tree", s.light_tree},
                        {"pixel", options.pixel},
                        {"threads", options.scene.threads}};
    write_json(options.json, json);
}

void run_reference_command(ReferenceOptions& options) {
    check_output_folder(options.out);
    check_output_folder(options.json);
    const WorkerLimit limit(options.scene.threads);
    LoadedScene loaded = load_scene(options.scene);
    const auto tracer = create_embree_tracer(loaded.world);
    ReferenceSettings& settings = options.settings;
    settings.width = options.scene.width;
    settings.height = options.scene.height;
    settings.seed = options.scene.seed;
    settings.camera = choose_camera(options.scene, loaded.scene, loaded.world);
    settings.box_pixel_filter = options.pixel == "box";
    settings.cancel = &interrupt_flag();
    const ReferenceResult result = render_reference(loaded.world, *tracer, settings);
    write_picture(options.out, result, options.scene.seed);
    if (!options.json.empty()) write_report(options, result);
    fmt::print(
        "{}: {} samples a pixel{}, relative error {}, {:.1f} Mrays in {:.1f} s, {} samples not finite\n",
        options.out.string(), result.spp, result.cancelled ? " (interrupted)" : "",
        result.spp > 1 ? fmt::format("{:.4f}", result.relative_error) : "unknown from one",
        1e-6 * double(result.rays), result.seconds, result.non_finite);
}

}  // namespace

void add_reference_command(CLI::App& app) {
    auto options = std::make_shared<ReferenceOptions>();
    CLI::App* command = app.add_subcommand(
        "reference", "Path-trace the reference: radiance and the variance of each pixel's mean, as OpenEXR");
    add_scene_options(*command, options->scene);
    command->add_option("--out", options->out, "EXR file with channels R G B and variance.R .G .B")
        ->required()
        ->check([](const std::string& path) {
            return std::filesystem::path(path).extension() == ".exr" ? std::string()
                                                                     : "'" + path + "' does not end in .exr";
        })
        ->type_name("F.exr");
    CLI::App* effort = command->add_option_group("effort");
    CLI::Option* spp = effort->add_option("--spp", options->settings.spp, "Samples a pixel")
                           ->check(CLI::Range(std::uint64_t(1), MAX_SPP));
    effort
        ->add_option_function<double>(
            "--relative-error",
            [options](double error) {
                options->settings.relative_error = error;
                options->settings.spp = MAX_SPP;
            },
            "Go on until the relative standard error, as root mean square over the pixels, is below this")
        ->check(make_finite_range(1e-9, 1e9))
        ->excludes(spp);
    effort->require_option(1);
    command
        ->add_option("--bounces", options->settings.bounces, "How often light is scattered; 1: direct light")
        ->check(CLI::Range(0, MAX_BOUNCES))
        ->capture_default_str();
    command->add_flag("--direct-only", options->settings.direct_only,
                      "Only emission and direct light, as the renderer computes them");
    command->add_flag("--light-tree", options->settings.light_tree,
                      "Draw lights by the light tree instead of by power: far less noise with many lights");
    command
        ->add_option(
            "--pixel", options->pixel,
            "Where rays pass through a pixel: its centre, as in the rasterizer, or anywhere in it (box)")
        ->check(CLI::IsMember({"centre", "box"}))
        ->capture_default_str();
    command->add_option("--json", options->json, "Write settings, counts and times to this file")
        ->type_name("F");
    command->callback([options] { run_reference_command(*options); });
}

}  // namespace tarn
