// tarn render: a picture of a scene through the GL renderer.
#include <algorithm>

#include "commands.h"
#include "core/display.h"
#include "core/error.h"
#include "core/log.h"
#include "core/version.h"
#include "image_io/image_io.h"
#include "interrupt.h"
#include "metrics/frame_mean.h"
#include "metrics/mean_error.h"
#include "session.h"

namespace tarn {
namespace {

struct RenderCommand {
    RenderOptions options;
    std::string out;
    int frames = 1;
    bool accumulate = false;
    double time_step_s = 0.0;  // 0: the scene is held
};

bool is_exr(const std::string& file) {
    return std::filesystem::path(file).extension() == ".exr";
}

void check_output(const std::string& file) {
    const std::string extension = std::filesystem::path(file).extension().string();
    if (extension != ".exr" && extension != ".png") {
        throw UsageError("{}: the picture's name must end in .exr or .png", file);
    }
    check_output_folder(file);
}

// What decides the picture's bits besides scene, camera and time; contexts and threads do not.
PictureNotes describe_picture(const RenderCommand& command) {
    std::string settings;
    for (const Setting& setting : setting_table()) {
        settings += fmt::format("{}{}={}", settings.empty() ? "" : " ", setting.name,
                                setting.format(command.options.settings));
    }
    return {{"software", describe_program()},
            {"tarn.settings", settings},
            {"tarn.run", fmt::format("seed={} frames={}{}", command.options.scene.seed, command.frames,
                                     command.accumulate ? " accumulated" : "")}};
}

void write_picture(const RenderCommand& command, const Image& radiance) {
    const std::string& file = command.out;
    const std::optional<float>& exposure_ev = command.options.exposure_ev;
    if (is_exr(file)) {
        write_exr(file, radiance, describe_picture(command));
    } else {
        const DisplayLook& look = command.options.look;
        const float ev = exposure_ev.value_or(auto_exposure_ev(radiance, look.tone));
        write_png(file, display_from_radiance(radiance, ev, look));
    }
}

// Moves the scene, and its camera with it, to the moment of a frame.
void move_to_frame(const RenderCommand& command, int frame, RenderSession& session, FrameInput& input) {
    SceneOptions then = command.options.scene;
    then.time_s = std::max(0.0, then.time_s) + frame * command.time_step_s;
    session.move_to(then.time_s);
    input.camera = choose_camera(then, session.loaded().scene, session.loaded().world);
}

// Frames of fresh_settings are independent; others share what they keep for each other.
int count_batch_frames(const RenderCommand& command) {
    constexpr int FRAMES_THAT_REMEMBER = 32;
    return command.options.names_preset ? FRAMES_THAT_REMEMBER : 1;
}

void print_error(int frames, const std::optional<double>& error) {
    if (error) fmt::print("mean of {} frames, error left about {:.2g} %\n", frames, 100.0 * *error);
}

nlohmann::json describe_error(int frames, const MeanError& error) {
    nlohmann::json json = {{"frames", frames}, {"batches", error.batches()}, {"relative_error", nullptr}};
    if (const auto left = error.relative_error()) json["relative_error"] = *left;
    return json;
}

void run_render(RenderCommand command) {
    RenderSettings& settings = command.options.settings;
    if (command.accumulate && !command.options.names_preset) settings = fresh_settings(settings);

    check_output(command.out);
    check_output_folder(command.options.json_file);
    RenderSession session(command.options);
    Renderer& renderer = session.renderer();
    FrameInput input;
    input.camera = choose_camera(command.options.scene, session.loaded().scene, session.loaded().world);
    input.seed = command.options.scene.seed;
    input.settings = command.options.settings;

    RunTotals totals;
    FrameMean mean;
    MeanError error(count_batch_frames(command));
    Image radiance;
    Progress progress("rendering", std::uint64_t(command.frames));
    for (int frame = 0; frame < command.frames; ++frame) {
        input.frame = std::uint32_t(frame);
        if (command.time_step_s > 0.0) move_to_frame(command, frame, session, input);
        const FrameOutput output = renderer.render(input);
        totals.add(output);
        const bool last = frame + 1 == command.frames;
        if (command.accumulate || last) radiance = renderer.read_radiance(output.radiance);
        if (command.accumulate) mean.add(radiance), error.add(radiance);
        progress.update(std::uint64_t(frame) + 1);
        if (last || !interrupt_flag()) continue;
        if (!command.accumulate) throw Error("interrupted; nothing was written");
        break;  // the mean so far is a picture too
    }
    if (command.accumulate) radiance = mean.mean();
    write_picture(command, radiance);
    if (command.accumulate) print_error(mean.frames(), error.relative_error());
    if (command.options.json_file.empty()) return;
    nlohmann::json report = make_report(command.options, session, totals);
    if (command.accumulate) report["accumulated"] = describe_error(mean.frames(), error);
    write_json(command.options.json_file, report);
}

}  // namespace

void add_render_command(CLI::App& app) {
    CLI::App* sub = app.add_subcommand("render", "Render a picture with the GL renderer");
    auto command = std::make_shared<RenderCommand>();
    add_picture_options(*sub, command->options);
    sub->add_option("--out", command->out,
                    "The picture: .exr (linear radiance) or .png (exposed, tone-mapped)")
        ->required();
    sub->add_option("--frames", command->frames, "Render this many frames and keep the last")
        ->check(CLI::Range(1, 1000000))
        ->capture_default_str();
    sub->add_flag(
        "--accumulate", command->accumulate,
        "Keep the mean of all frames instead of the last, and say what error is left. Frames are fresh, "
        "unbiased estimates, unless --preset or --raw says otherwise");
    sub->add_option("--time-step", command->time_step_s, "Move the animation on by this much a frame, s")
        ->check(make_finite_range(0.0, 1e6))
        ->capture_default_str();
    sub->callback([command] { run_render(*command); });
}

}  // namespace tarn
