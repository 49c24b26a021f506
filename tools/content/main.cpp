// tarn-content: writes one of the project's scenes as a .glb file. Exit status as tarn's: 0, 1 (cannot), 2
// (usage).
#include <CLI/CLI.hpp>
#include <cstdio>
#include <exception>

#include "content/scenes.h"

namespace {

int run(int argc, char** argv) {
    using namespace tarn::content;
    CLI::App app{
        "Writes one of Tarn's own scenes as a binary glTF file; the same options give the same bytes."};
    std::string scene, out;
    SceneOptions options;
    app.add_option("scene", scene, "Which scene")->required()->check(CLI::IsMember(list_scenes()));
    app.add_option("--out", out, "The .glb file to write")->required();
    app.add_option("--count", options.count, "many_lights: number of emissive triangles, 1 to 1000000")
        ->capture_default_str();
    app.add_option("--moving", options.moving_percent, "many_lights: per cent of them that drift, 0 to 100")
        ->capture_default_str();
    app.add_option("--saturation", options.saturation,
                   "many_lights, coloured_lights: of the lights' colours, 0 (all white) to 1 (pure hues)")
        ->capture_default_str();
    app.add_option("--seed", options.seed, "Seed of everything random")->capture_default_str();
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        return app.exit(error) == 0 ? 0 : 2;
    }
    write_file(out, generate_scene(scene, options));
    return 0;
}

}  // namespace

int main(int argc, char** argv) {
    try {
        return run(argc, argv);
    } catch (const std::exception& error) {
        std::fprintf(stderr, "tarn-content: %s\n", error.what());
        return 1;
    }
}
