// tarn: renders, measures and shows scenes. Exit status: 0; 1 with one line on stderr where a file,
// a driver or a disk fails; 2 for wrong usage; 3 where a value is beyond the user's limit; 130 after Ctrl-C,
// whatever was kept.
#include <algorithm>
#include <cstdio>
#include <exception>
#include <string>
#include <vector>

#include "commands.h"
#include "core/error.h"
#include "core/near_names.h"
#include "core/version.h"
#include "game/window.h"
#include "interrupt.h"
#include "rays/ray_tracer.h"
#include "verdict.h"

namespace tarn {
namespace {

constexpr int WRONG_USAGE = 2;
constexpr int LIMIT_PASSED = 3;
constexpr int INTERRUPTED = 130;  // 128 + SIGINT, as shells have it

void add_commands(CLI::App& app) {
    add_info_command(app);
    add_render_command(app);
    add_reference_command(app);
    add_compare_command(app);
    add_bench_command(app);
    add_flythrough_command(app);
    add_floors_command(app);
    add_report_command(app);
    add_study_command(app);
    add_view_command(app);
}

// Throws UsageError where the first argument is neither an option nor a command.
void check_command(const CLI::App& app, int argc, char** argv) {
    if (argc < 2 || argv[1][0] == '-') return;
    std::vector<std::string> names;
    for (const CLI::App* command : app.get_subcommands({})) names.push_back(command->get_name());
    const std::string name = argv[1];
    if (std::find(names.begin(), names.end(), name) != names.end()) return;
    throw UsageError("'{}' is no command; there are: {}{}", name, fmt::join(names, ", "),
                     suggest_names(name, names));
}

int run(int argc, char** argv) {
    CLI::App app{
        "Tarn: an OpenGL 4.5 deferred rasterizer with resampled lights and Embree shadows, on the CPU."};
    app.set_version_flag("--version", [] {
        return fmt::format("{}\nEmbree {}, GLFW {}", describe_program(), describe_ray_library(),
                           game::describe_window_library());
    });
    app.require_subcommand(1);
    add_commands(app);
    check_command(app, argc, argv);
    try {
        app.parse(argc, argv);
        return interrupt_flag() ? INTERRUPTED : 0;
    } catch (const CLI::ParseError& error) {
        const int status = app.exit(error);
        return status == 0 ? 0 : WRONG_USAGE;
    }
}

}  // namespace
}  // namespace tarn

int main(int argc, char** argv) {
    try {
        return tarn::run(argc, argv);
    } catch (const tarn::LimitPassed& verdict) {
        std::fprintf(stderr, "tarn: %s\n", verdict.what());
        return tarn::LIMIT_PASSED;
    } catch (const tarn::UsageError& error) {
        std::fprintf(stderr, "tarn: %s\n", error.what());
        return tarn::WRONG_USAGE;
    } catch (const std::exception& error) {
        std::fprintf(stderr, "tarn: %s\n", error.what());
        return tarn::interrupt_flag() ? tarn::INTERRUPTED : 1;
    }
}
