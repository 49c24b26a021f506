// tarn flythrough: plays a camera path without a window and writes pictures, timings and errors.
#include <algorithm>
#include <cmath>
#include <filesystem>

#include "commands.h"
#include "core/display.h"
#include "core/error.h"
#include "core/interrupt.h"
#include "core/log.h"
#include "image_io/image_io.h"
#include "metrics/flip.h"
#include "metrics/image_error.h"
#include "reference/reference.h"
#include "scene/camera_path.h"
#include "session.h"

namespace tarn {
namespace {

struct FlythroughCommand {
    RenderOptions options;
    std::string path_file;
    std::string out = "out/flythrough";
    int frames = 60;
    int pictures = 10;
    int measured = 3;
    int reference_spp = 64;
};

struct Errors {
    int frame = 0;
    ImageErrors errors;
    double flip_ldr = 0.0;
    double reference_error = 0.0;
};

std::filesystem::path default_path_file() {
    return std::filesystem::path(TARN_FLYTHROUGH_DIR) / "lantern_court.json";
}

// Whether `frame` is one of `count` that are spread evenly over `frames`, each in the middle of its stretch.
bool is_chosen(int frame, int frames, int count) {
    const auto stretch = [&](int f) { return (2ll * f * count + frames) / (2ll * frames); };
    return count >= frames || stretch(frame) != stretch(frame - 1);
}

std::string frame_name(const char* stem, int frame, const char* extension) {
    return fmt::format("{}_{:04}.{}", stem, frame, extension);
}

// The exposure of the whole flight, from its first frame, so that pictures can be compared.
float choose_exposure(const RenderOptions& options, const Image& radiance) {
    return options.exposure_ev.value_or(auto_exposure_ev(radiance));
}

Errors measure(const FlythroughCommand& command, RenderSession& session, const FrameInput& input,
               const Image& radiance, float exposure_ev) {
    ReferenceSettings settings;
    settings.width = radiance.width;
    settings.height = radiance.height;
    settings.camera = input.camera;
    settings.direct_only = true;
    settings.spp = std::uint64_t(command.reference_spp);
    settings.seed = input.seed + 1;
    settings.cancel = &interrupt_flag();
    const ReferenceResult reference = render_reference(session.loaded().world, session.tracer(), settings);
    const std::filesystem::path out = command.out;
    const Image reference_display = display_from_radiance(reference.radiance, exposure_ev);
    write_png(out / frame_name("reference", int(input.frame), "png"), reference_display);
    Errors result;
    result.frame = int(input.frame);
    result.errors = compute_image_errors(reference.radiance, radiance, std::exp2(exposure_ev));
    result.flip_ldr =
        mean_error(compute_ldr_flip(reference_display, display_from_radiance(radiance, exposure_ev)));
    result.reference_error = reference.relative_error;
    return result;
}

nlohmann::json to_json(const std::vector<Errors>& measured) {
    nlohmann::json list = nlohmann::json::array();
    for (const Errors& m : measured) {
        list.push_back({{"frame", m.frame},
                        {"mse", m.errors.mse},
                        {"rel_mse", m.errors.rel_mse},
                        {"rel_mse_trimmed", m.errors.rel_mse_trimmed},
                        {"mape", m.errors.mape},
                        {"mean_ratio", m.errors.mean_ratio},
                        {"flip_ldr", m.flip_ldr},
                        {"reference_relative_error", m.reference_error}});
    }
    return list;
}

void print_summary(const FlythroughCommand& command, const RunTotals& totals,
                   const std::vector<Errors>& measured) {
    fmt::print("{} frames: median {:.1f} ms, p95 {:.1f} ms a frame\n", totals.frames,
               totals.timings.frame_quantile_ms(0.5), totals.timings.frame_quantile_ms(0.95));
    for (const PassTiming& pass : totals.timings.pass_medians())
        fmt::print("  {:<24} {:8.2f} ms\n", pass.name, pass.ms);
    for (const Errors& m : measured) {
        fmt::print(
            "  frame {:4}: relMSE {:.4f}, FLIP {:.4f}, energy {:.4f} of the reference (itself good to {:.1f} "
            "%)\n",
            m.frame, m.errors.rel_mse, m.flip_ldr, m.errors.mean_ratio, 100.0 * m.reference_error);
    }
    fmt::print("Pictures, timings and errors are in {}\n", std::filesystem::absolute(command.out).string());
}

void run_flythrough(FlythroughCommand& command) {
    const CameraPath path = load_camera_path(
        command.path_file.empty() ? default_path_file() : std::filesystem::path(command.path_file));
    if (command.options.scene.scene.empty()) command.options.scene.scene = path.scene;
    if (command.options.scene.scene.empty()) throw Error("{}: names no scene; give one", command.path_file);
    check_output_folder(command.options.json_file);
    create_folder(command.out);
    RenderSession session(command.options);
    Renderer& renderer = session.renderer();
    const double aspect = double(renderer.width_px()) / renderer.height_px();

    RunTotals totals;
    std::vector<Errors> measured;
    std::optional<float> exposure_ev;
    Progress progress("flying", std::uint64_t(command.frames));
    for (int frame = 0; frame < command.frames && !interrupt_flag(); ++frame) {
        const double time_s = path.duration_s * frame / std::max(1, command.frames - 1);
        session.move_to(time_s);
        const CameraKey key = evaluate_camera_path(path, time_s);
        FrameInput input;
        input.camera =
            look_at(session.loaded().world, key.position_ws, key.target_ws, key.vertical_fov_deg, aspect);
        input.frame = std::uint32_t(frame);
        input.seed = command.options.scene.seed;
        input.settings = command.options.settings;
        const FrameOutput output = renderer.render(input);
        totals.add(output);
        const bool measure_now = is_chosen(frame, command.frames, command.measured);
        if (is_chosen(frame, command.frames, command.pictures) || measure_now) {
            const Image radiance = renderer.read_radiance(output.radiance);
            if (!exposure_ev) exposure_ev = choose_exposure(command.options, radiance);
            write_png(std::filesystem::path(command.out) / frame_name("frame", frame, "png"),
                      display_from_radiance(radiance, *exposure_ev));
            if (measure_now) measured.push_back(measure(command, session, input, radiance, *exposure_ev));
        }
        progress.update(std::uint64_t(frame) + 1);
    }
    nlohmann::json report = make_report(command.options, session, totals);
    report["errors"] = to_json(measured);
    report["exposure_ev"] = exposure_ev.value_or(0.0f);
    report["interrupted"] = bool(interrupt_flag());
    const std::filesystem::path report_file = std::filesystem::path(command.out) / "report.json";
    write_json(report_file, report);
    if (!command.options.json_file.empty()) write_json(command.options.json_file, report);
    print_summary(command, totals, measured);
}

}  // namespace

void add_flythrough_command(CLI::App& app) {
    CLI::App* sub = app.add_subcommand(
        "flythrough", "Play a camera path without a window; write pictures, timings and errors");
    auto command = std::make_shared<FlythroughCommand>();
    add_render_options(*sub, command->options);
    sub->get_option("SCENE")->required(false)->description(
        "glTF file or generated scene (default: the path's own)");
    // The path says where from and when.
    sub->remove_option(sub->get_option("--camera"));
    sub->remove_option(sub->get_option("--time"));
    sub->add_option("--path", command->path_file,
                    "Camera path, a JSON file (default: through lantern_court)");
    sub->add_option("--out", command->out, "Folder for the pictures and report.json")->capture_default_str();
    sub->add_option("--frames", command->frames, "Frames along the path")
        ->check(CLI::Range(1, 1000000))
        ->capture_default_str();
    sub->add_option("--pictures", command->pictures, "How many frames to write as PNG")
        ->check(CLI::Range(0, 1000000))
        ->capture_default_str();
    sub->add_option("--measured", command->measured, "How many frames to measure against the reference")
        ->check(CLI::Range(0, 1000000))
        ->capture_default_str();
    sub->add_option("--reference-spp", command->reference_spp, "Samples a pixel of that reference")
        ->check(CLI::Range(2, 1000000))
        ->capture_default_str();
    sub->callback([command] { run_flythrough(*command); });
}

}  // namespace tarn
