// tarn view: a window on a scene.
#include <memory>

#include "commands.h"
#include "core/error.h"
#include "viewer.h"

namespace tarn {
namespace {

void add_view_options(CLI::App& command, ViewOptions& options) {
    command.get_option("SCENE")->required(false)->default_str("lantern_court");
    command.get_option("--size")->description("Size of the window, px")->default_str("1280x720");
    command.get_option("--context")->description("Where GL comes from: a window comes from glfw alone");
    command.get_option("--exposure")->description("Exposure of the picture, EV (default: automatic)");
    command.remove_option(command.get_option("--json"));
    command
        .add_option("--resolution", options.resolution_percent,
                    "Width and height of the rendered picture, percent of the window's")
        ->check(CLI::Range(1, 100))
        ->capture_default_str();
    const auto parse_view = [&options](const std::string& name) {
        try {
            options.view = parse_display_view(name);
        } catch (const Error& error) {
            throw CLI::ValidationError("--view", error.what());
        }
    };
    command
        .add_option_function<std::string>("--view", parse_view, "What to show first: " + list_display_views())
        ->default_str("radiance");
    command.add_option("--frames", options.frames, "Quit after so many frames (0: never)")
        ->check(CLI::NonNegativeNumber)
        ->capture_default_str();
    command
        .add_option("--screenshot", options.screenshot,
                    "Write the last picture, without the panel, when quitting")
        ->type_name("F.png");
}

}  // namespace

void add_view_command(CLI::App& app) {
    CLI::App* command = app.add_subcommand("view", "Fly through a scene in a window");
    auto options = std::make_shared<ViewOptions>();
    options->render.context = "glfw";
    options->render.scene.scene = "lantern_court";
    options->render.scene.width = 1280;
    options->render.scene.height = 720;
    add_render_options(*command, options->render);
    add_view_options(*command, *options);
    command->footer(
        "W A S D Q E fly, Shift is faster, the wheel changes the speed; drag with the right button to look.\n"
        "Tab: panel. Space: animation. F5: reload shaders. F12: screenshot. Escape: end.");
    command->callback([options] { Viewer(*options).run(); });
}

}  // namespace tarn
