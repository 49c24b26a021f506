// tarn render: a picture of a scene through the GL renderer.
#include <algorithm>

#include "commands.h"
#include "core/display.h"
#include "core/error.h"
#include "core/log.h"
#include "core/version.h"
#include "image_io/image_io.h"
#include "metrics/frame_mean.h"
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
        throw Error("{}: the picture's name must end in .exr or .png", file);
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

void run_render(const RenderCommand& command) {
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
    Image radiance;
    Progress progress("rendering", std::uint64_t(command.frames));
    for (int frame = 0; frame < command.frames; ++frame) {
        input.frame = std::uint32_t(frame);
        if (command.time_step_s > 0.0) move_to_frame(command, frame, session, input);
        const FrameOutput output = renderer.render(input);
        totals.add(output);
        const bool last = frame + 1 == command.frames;
        if (command.accumulate || last) radiance = renderer.read_radiance(output.radiance);
        if (command.accumulate) mean.add(radiance);
        progress.update(std::uint64_t(frame) + 1);
    }
    if (command.accumulate) radiance = mean.mean();
    write_picture(command, radiance);
    if (!command.options.json_file.empty()) {
        write_json(command.options.json_file, make_report(command.options, session, totals));
    }
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
    sub->add_flag("--accumulate", command->accumulate, "Keep the mean of all frames instead of the last");
    sub->add_option("--time-step", command->time_step_s, "Move the animation on by this much a frame, s")
        ->check(make_finite_range(0.0, 1e6))
        ->capture_default_str();
    sub->callback([command] { run_render(*command); });
}

}  // namespace tarn
