// tarn-sandbox: plays in a scene, records what is done there, and plays it again. Exit status: 0; 1 with one
// line on stderr where a file, a driver or a disk fails; 2 for wrong usage.
#include <CLI/CLI.hpp>
#include <atomic>
#include <csignal>
#include <cstdio>
#include <exception>
#include <optional>

#include "../user_folders.h"
#include "replay_player.h"
#include "sandbox.h"

namespace game {
namespace {

constexpr int WRONG_USAGE = 2;

std::atomic<bool> is_interrupted{false};

struct Options {
    std::string scene = "lantern_court";
    std::string preset = "clean";
    double scale = 0.5;
    std::string size = "960x540";
    std::uint32_t seed = 0;
    int threads = 0;
    double frame_ms = 33.0;
    std::optional<int> fireflies;
    std::string record;
    std::string replay;
    bool continues = false;
    bool headless = false;
    bool times = false;
    std::string folder;
    int every = 1;
};

Size parse_size(const std::string& text) {
    Size size;
    int used = 0;
    if (std::sscanf(text.c_str(), "%dx%d%n", &size.width_px, &size.height_px, &used) != 2 ||
        std::size_t(used) != text.size() || size.width_px < 1 || size.height_px < 1 ||
        size.width_px > 16384 || size.height_px > 16384) {
        throw CLI::ValidationError("--size", "'" + text + "' is no size such as 960x540");
    }
    return size;
}

// Who asks for a save must have a folder; others play without.
std::filesystem::path find_saves(const Options& options) try {
    return find_data_folder();
} catch (const Error& error) {
    if (options.continues) throw;
    std::fprintf(stderr, "tarn-sandbox: nothing is saved: %s\n", error.what());
    return {};
}

// As the user's file says. Where there is none and none can be written, the keys are as usual.
KeyMap find_keys() {
    std::filesystem::path file;
    try {
        file = find_settings_folder() / "keys.ini";
        if (!std::filesystem::exists(file)) write_whole(file, describe_keys(KeyMap()));
    } catch (const Error& error) {
        std::fprintf(stderr, "tarn-sandbox: the keys are as usual: %s\n", error.what());
        return {};
    }
    return load_keys(file);
}

void play(const Options& options) {
    SandboxOptions sandbox;
    sandbox.source.scene = options.scene;
    sandbox.source.fireflies = options.fireflies;
    sandbox.settings = Settings::preset(options.preset);
    sandbox.settings.set_number("scale", options.scale);
    sandbox.preset = options.preset;
    sandbox.seed = options.seed;
    sandbox.threads = options.threads;
    sandbox.frame_ms = options.frame_ms;
    sandbox.record = options.record;
    sandbox.saves = find_saves(options);
    sandbox.keys = find_keys();
    sandbox.continues = options.continues;
    sandbox.stop = [] { return is_interrupted.load(); };
    std::unique_ptr<Stage> stage = load_stage(sandbox.source);
    const Size size = parse_size(options.size);
    Window window({"Tarn sandbox", size.width_px, size.height_px, options.threads});
    Sandbox(window, std::move(stage), sandbox).run();
}

void replay(const Options& options) {
    const Replay recorded = load_replay(options.replay);
    ReplayOptions how;
    how.file = options.replay;
    how.folder = options.folder;
    how.every = options.every;
    how.threads = options.threads;
    how.prints_times = options.times;
    how.stop = [] { return is_interrupted.load(); };
    make_look(recorded, how.file);
    const std::unique_ptr<Stage> stage = load_stage({recorded.scene, {}, recorded.fireflies});
    if (options.headless) return play_replay(*stage, recorded, how, nullptr);
    Window window({"Tarn sandbox: replay", recorded.width_px, recorded.height_px, options.threads});
    play_replay(*stage, recorded, how, &window);
}

void add_options(CLI::App& app, Options& options) {
    app.add_option("SCENE", options.scene, "A .gltf or .glb file, or the name of one of Tarn's scenes")
        ->capture_default_str();
    app.add_option("--preset", options.preset, "How light is computed: a name of 'tarn render --help'")
        ->capture_default_str();
    app.add_option("--scale", options.scale, "Width and height of what is rendered, relative to the window")
        ->check(CLI::Range(0.25, 1.0))
        ->capture_default_str();
    app.add_option("--size", options.size, "Size of the window, px")->capture_default_str();
    app.add_option("--seed", options.seed, "Seed of all random numbers")->capture_default_str();
    app.add_option("--threads", options.threads, "Worker threads (0: one per core)")
        ->check(CLI::Range(0, 1024))
        ->capture_default_str();
    app.add_option(
           "--frame-ms", options.frame_ms,
           "What a frame may take, ms: where it takes longer, less is rendered; 0: nothing is changed")
        ->check(CLI::Range(0.0, 1000.0))
        ->capture_default_str();
    CLI::Option* fireflies =
        app.add_option("--fireflies", options.fireflies,
                       "How many there are; unless said, 60 in lantern_court and none elsewhere")
            ->check(CLI::Range(0, FIREFLY_LIMIT));
    CLI::Option* record = app.add_option("--record", options.record, "Write what is done to this file");
    CLI::Option* replay =
        app.add_option("--replay", options.replay, "Do what this file says")->excludes(record, fireflies);
    app.add_flag("--continue", options.continues,
                 "Go on from the automatic save of this scene, under $XDG_DATA_HOME/tarn or "
                 "~/.local/share/tarn")
        ->excludes(record, replay);
    CLI::Option* folder =
        app.add_option("--out", options.folder, "Write the replay's frames as PNG files to this folder");
    app.add_flag("--times", options.times, "Print the median time of the replay's frames")->needs(replay);
    app.add_flag("--headless", options.headless, "Without a window")->needs(replay)->needs(folder);
    folder->needs(replay);
    app.add_option("--every", options.every, "Of the replay's steps, 60 a second, draw every so many")
        ->needs(replay)
        ->check(CLI::Range(1, 1000))
        ->capture_default_str();
}

int run(int argc, char** argv) {
    CLI::App app{"Walk through a scene at night, throw glowing balls, relight dead lanterns."};
    app.footer(
        "W A S D walk, Shift runs, Space jumps, C crouches; the mouse looks, its left button throws a ball.\n"
        "E: light a lantern. F: a torch. F1: all keys. F2: panel. F5, F9: save, load. F12: screenshot, with "
        "Shift as EXR. "
        "Escape: free the mouse, "
        "then quit.\n"
        "Keys are read from $XDG_CONFIG_HOME/tarn/keys.ini or ~/.config/tarn/keys.ini, which is written "
        "when it is missing.");
    Options options;
    add_options(app, options);
    try {
        app.parse(argc, argv);
        parse_size(options.size);
    } catch (const CLI::ParseError& error) {
        return app.exit(error) == 0 ? 0 : WRONG_USAGE;
    }
    for (const int signal : {SIGINT, SIGTERM}) std::signal(signal, [](int) { is_interrupted = true; });
    options.replay.empty() ? play(options) : replay(options);
    return 0;
}

}  // namespace
}  // namespace game

int main(int argc, char** argv) {
    try {
        return game::run(argc, argv);
    } catch (const std::exception& error) {
        std::fprintf(stderr, "tarn-sandbox: %s\n", error.what());
        return 1;
    }
}
