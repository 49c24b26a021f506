// tarn view: a window on a scene. Translates the command line's options to those of the game's viewer.
#include <memory>

#include "commands.h"
#include "core/error.h"
#include "game/viewer.h"
#include "interrupt.h"
#include "passes/display.h"
#include "rays/ray_tracer.h"
#include "session.h"

namespace tarn {
namespace {

// A quarter of the pixels: a window is to follow the hand.
constexpr double VIEW_SCALE = 0.5;

struct ViewOptions {
    RenderOptions render;
    game::ViewerOptions viewer;
};

void add_view_options(CLI::App& command, game::ViewerOptions& options) {
    command.get_option("SCENE")->required(false)->default_str("lantern_court");
    command.get_option("--size")->description("Size of the window, px")->default_str("1280x720");
    command.get_option("--context")->description("Where GL comes from: a window comes from glfw alone");
    command.get_option("--exposure")->description("Exposure of the picture, EV (default: automatic)");
    command.remove_option(command.get_option("--json"));
    command.get_option("--scale")->default_str(fmt::format("{}", VIEW_SCALE));
    const auto parse_view = [&options](const std::string& name) {
        try {
            parse_display_view(name);
        } catch (const Error& error) {
            throw CLI::ValidationError("--view", error.what());
        }
        options.view = name;
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

api::Scene load_public_scene(const SceneOptions& options) {
    api::SceneOptions result;
    if (options.environment) result.environment = *options.environment;
    result.sky = options.sky;
    result.scene_index = options.scene_index;
    result.time_s = options.time_s;
    return api::Scene::load(resolve_scene_path(options.scene), result);
}

// nullopt: no --camera.
std::optional<api::Camera> choose_public_camera(const std::string& text, const api::Scene& scene) {
    if (text.empty()) return std::nullopt;
    std::vector<std::string> names;
    for (std::size_t i = 0; i < scene.camera_count(); ++i) names.push_back(scene.camera_name(i));
    const CameraChoice choice = parse_camera(text, names);
    if (choice.index) return scene.camera(*choice.index);
    const auto& [px, py, pz] = choice.position_ws;
    const auto& [tx, ty, tz] = choice.target_ws;
    return api::Camera::look_at({px, py, pz}, {tx, ty, tz}, choice.vertical_fov_deg);
}

api::Settings make_public_settings(const RenderSettings& settings) {
    api::Settings result;
    for (const Setting& row : setting_table()) result.set_number(row.name, row.get(settings));
    return result;
}

game::WindowOptions make_window_options(const RenderOptions& options) {
    if (options.context != "glfw") {
        throw Error(
            "tarn view shows a window: --context is '{}', it must be glfw; without a window use 'tarn "
            "render' "
            "or 'tarn flythrough'",
            options.context);
    }
    return {"Tarn", options.scene.width, options.scene.height, options.scene.threads};
}

std::unique_ptr<game::Window> open_window(const RenderOptions& options) {
    const game::WindowOptions window = make_window_options(options);
    try {
        return std::make_unique<game::Window>(window);
    } catch (const api::Error& error) {
        throw Error("{}; 'tarn render' and 'tarn flythrough' need no display", error.what());
    }
}

void run_view(const ViewOptions& options) {
    const SceneOptions& scene_options = options.render.scene;
    const WorkerLimit workers(scene_options.threads);
    api::Scene scene = load_public_scene(scene_options);
    game::ViewerOptions viewer = options.viewer;
    viewer.scene_name = scene_options.scene.stem().string();
    viewer.camera = choose_public_camera(scene_options.camera, scene);
    viewer.settings = make_public_settings(options.render.settings);
    viewer.preset = options.render.preset;
    viewer.exposure_ev = options.render.exposure_ev;
    viewer.glare_strength = options.render.look.glare;
    viewer.tone = tone_curve_names()[std::size_t(options.render.look.tone)];
    viewer.seed = scene_options.seed;
    viewer.time_s = scene_options.time_s;
    viewer.threads = scene_options.threads;
    viewer.stop = [] { return interrupt_flag().load(); };
    const auto window = open_window(options.render);
    game::Viewer(*window, std::move(scene), viewer).run();
}

}  // namespace

void add_view_command(CLI::App& app) {
    CLI::App* command = app.add_subcommand("view", "Fly through a scene in a window");
    auto options = std::make_shared<ViewOptions>();
    options->render.context = "glfw";
    options->render.scene.scene = "lantern_court";
    options->render.scene.width = 1280;
    options->render.scene.height = 720;
    add_picture_options(*command, options->render);
    add_view_options(*command, options->viewer);
    command->footer(
        "W A S D Q E fly, Shift is faster, the wheel changes the speed; drag with the right button to look.\n"
        "Tab: panel. Space: animation. F5: reload shaders. F12: screenshot. Escape: end.");
    command->callback([command, options] {
        if (command->count("--scale") == 0) options->render.settings.antialias.scale = VIEW_SCALE;
        run_view(*options);
    });
}

}  // namespace tarn
