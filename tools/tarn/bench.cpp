// tarn bench: error against time of several methods, at equal time and at equal error, with bias apart from
// noise.
#include "bench/bench_run.h"

#include <algorithm>
#include <bit>

#include "bench/compare_results.h"
#include "bench/equal_time.h"
#include "bench/file_names.h"
#include "bench/hash.h"
#include "bench/reference_cache.h"
#include "bench/report.h"
#include "bench/results.h"
#include "commands.h"
#include "core/error.h"
#include "find_truth.h"
#include "gl/shader_source.h"
#include "interrupt.h"
#include "renderer_source.h"
#include "session.h"

namespace tarn {
namespace {

using Json = nlohmann::ordered_json;

constexpr int MAX_FRAMES = 4096;

struct BenchCommand {
    RenderOptions options;
    std::vector<std::string> scenes = {"lantern_court"};
    std::string methods;
    std::vector<double> budgets_ms = {50.0, 200.0};
    int seeds = 8;
    int frames = 32;
    int warm_up_frames = -1;  // as each method has it
    double walk_m_per_s = 0.0;
    double turn_deg_per_s = 0.0;
    int reference_spp = 512;
    std::string out = "out/bench";
    std::string compare;  // results.json of an earlier run
};

// Speeds of a camera are of pictures shown at this rate.
constexpr double FRAMES_PER_S = 60.0;

CameraMotion camera_motion(const BenchCommand& command) {
    return {command.walk_m_per_s / FRAMES_PER_S, command.turn_deg_per_s / FRAMES_PER_S};
}

// Those of direct light: methods of a run must share their reference.
std::string default_method_names() {
    std::string names;
    for (const Method& method : method_table()) {
        if (method.settings.indirect.runs()) continue;
        names += (names.empty() ? "" : ",") + method.label;
    }
    return names;
}

BenchPlan make_plan(const BenchCommand& command) {
    BenchPlan plan;
    plan.methods = parse_methods(command.methods);
    plan.budgets_ms = command.budgets_ms;
    std::erase(plan.budgets_ms, 0.0);
    std::sort(plan.budgets_ms.begin(), plan.budgets_ms.end());
    plan.seeds = command.seeds;
    plan.first_seed = command.options.scene.seed;
    plan.frames = command.frames;
    plan.moving = !camera_motion(command).is_still();
    for (Method& method : plan.methods) {
        const bool has_past = method.warm_up_frames > 0;
        if (command.warm_up_frames >= 0 && has_past) method.warm_up_frames = command.warm_up_frames;
    }
    return plan;
}

Json describe_plan(const BenchCommand& command, const BenchPlan& plan) {
    Json json = {{"width", command.options.scene.width},
                 {"height", command.options.scene.height},
                 {"camera", command.options.scene.camera},
                 {"time_s", command.options.scene.time_s},
                 {"context", command.options.context},
                 {"threads", command.options.scene.threads},
                 {"seeds", plan.seeds},
                 {"first_seed", plan.first_seed},
                 {"frames", plan.frames},
                 {"walk_m_per_s", command.walk_m_per_s},
                 {"turn_deg_per_s", command.turn_deg_per_s},
                 {"budgets_ms", plan.budgets_ms},
                 {"reference_spp", command.reference_spp}};
    json["exposure_ev"] = nullptr;
    if (command.options.exposure_ev) json["exposure_ev"] = *command.options.exposure_ev;
    json["methods"] = Json::array();
    for (const Method& method : plan.methods) {
        json["methods"].push_back({{"label", method.label},
                                   {"warm_up_frames", method.warm_up_frames},
                                   {"settings", describe_settings(method.settings)}});
    }
    return json;
}

Json bench_scene(const BenchCommand& command, const BenchPlan& plan, const std::string& scene, Json& machine,
                 std::vector<WorkFolder>& works) {
    RenderOptions options = command.options;
    options.scene.scene = scene;
    RenderSession session(options);
    machine = session.describe_machine();
    const World& world = session.loaded().world;
    const CameraRecord camera = choose_camera(options.scene, session.loaded().scene, world);
    ReferenceSettings reference = truth_settings(options.scene.width, options.scene.height, camera,
                                                 command.reference_spp, count_bounces(plan.methods));
    reference.box_pixel_filter = any_antialiases(plan.methods);

    const std::string name = std::filesystem::path(scene).stem().string();
    const std::filesystem::path out = command.out;
    const WorkFolder work(out / "unfinished" / file_stem(name),
                          {{"plan", describe_plan(command, plan)},
                           {"reference", describe_reference_key(world, reference)},
                           {"program", hash_program(get_shader_root())},
                           {"machine", machine}});
    works.push_back(work);
    if (work.is_resumed()) fmt::print("{}: going on where an earlier run stopped\n", name);
    const Truth truth = find_truth(session, options, reference);

    RendererSource source(world, session.tracer(), options.scene.width, options.scene.height);
    source.set_camera(camera, camera_motion(command));
    const std::vector<Cell> cells = plan_cells(plan, source, work);
    measure_cells(plan, cells, source, truth, work, interrupt_flag());

    Json json = {{"name", name}, {"camera", options.scene.camera}};
    json["width"] = options.scene.width;
    json["height"] = options.scene.height;
    json["reference"] = describe_truth(truth, out, name);
    json["methods"] = describe_methods(plan, cells, truth, work, out, name);
    json["equal_error"] = describe_equal_error(json["methods"]);
    json["equal_time"] = describe_equal_time(json["methods"]);
    return json;
}

std::string describe_cell(const Json& method, const Json& cell) {
    const std::string label = method["label"].get<std::string>();
    return cell["budget_ms"].is_null() ? fmt::format("{} {}", label, cell["kind"].get<std::string>())
                                       : fmt::format("{} {:g} ms", label, cell["budget_ms"].get<double>());
}

// Of the column that names the cells.
std::size_t find_label_width(const Json& scene) {
    std::size_t width = 28;
    for (const Json& method : scene["methods"]) {
        for (const Json& cell : method["cells"]) width = std::max(width, describe_cell(method, cell).size());
    }
    return width;
}

void print_cell(const Json& cell, const std::string& label, std::size_t label_width) {
    const auto value = [&](const char* name, const char* part) {
        return cell["errors"][name][part].get<double>();
    };
    const auto reach = [&](const char* name) { return value(name, "high") - value(name, "mean"); };
    const Json& split = cell["relative_bias"];
    fmt::print("  {:<{}} {:8.1f} {:7} {:>18} {:9.4f} {:>15} {:13.4f} {:>22}\n", label, label_width,
               cell["ms"]["median"].get<double>(), cell["frames"].get<int>(),
               fmt::format("{:.4f} +- {:.4f}", value("rel_mse", "mean"), reach("rel_mse")),
               value("flip_ldr", "mean"),
               fmt::format("{:.3f} +- {:.3f}", value("mean_ratio", "mean"), reach("mean_ratio")),
               split["variance"].get<double>(),
               fmt::format("{:.1e} .. {:.1e}", split["low"].get<double>(), split["high"].get<double>()));
}

void print_scene(const Json& scene) {
    fmt::print(
        "\n{}: against {} samples a pixel (relMSE of its own: {:.2g}), {} pixels on silhouettes left out; "
        "errors at {:+.2f} EV\n",
        scene["name"].get<std::string>(), scene["reference"]["spp"].get<std::uint64_t>(),
        scene["reference"]["noise_rel_mse"].get<double>(),
        scene["reference"]["left_out_pixels"].get<std::uint64_t>(),
        scene["reference"]["exposure_ev"].get<double>());
    const std::size_t label_width = find_label_width(scene);
    fmt::print("  {:<{}} {:>8} {:>7} {:>18} {:>9} {:>15} {:>13} {:>22}\n", "method", label_width, "ms",
               "frames", "relMSE", "FLIP", "energy", "rel. variance", "rel. bias^2 (95 %)");
    for (const Json& method : scene["methods"]) {
        for (const Json& cell : method["cells"]) print_cell(cell, describe_cell(method, cell), label_width);
        const Json& slope = method["slope"];
        if (slope["mean"].is_number()) {
            fmt::print("  {:<{}} MSE falls with time to the power {:.3f} ({:.3f} .. {:.3f})\n",
                       method["label"].get<std::string>(), label_width, slope["mean"].get<double>(),
                       slope["low"].get<double>(), slope["high"].get<double>());
        }
    }
}

void print_equal_time(const Json& scene) {
    for (const Json& budget : scene["equal_time"]) {
        fmt::print("\n{} at {:g} ms: relMSE, and how many times that of {} it is (95 %)\n",
                   scene["name"].get<std::string>(), budget["budget_ms"].get<double>(),
                   budget["best"].is_null() ? "the best" : budget["best"].get<std::string>());
        for (const Json& ratio : budget["ratios"]) {
            if (!ratio["reason"].is_null()) {
                fmt::print("  {:<28} {:8.1f} ms  {:10.5f}  not compared: {}\n",
                           ratio["label"].get<std::string>(), ratio["ms"].get<double>(),
                           ratio["rel_mse"].get<double>(), ratio["reason"].get<std::string>());
                continue;
            }
            fmt::print("  {:<28} {:8.1f} ms  {:10.5f}  {:8.2f} x ({:.2f} .. {:.2f})\n",
                       ratio["label"].get<std::string>(), ratio["ms"].get<double>(),
                       ratio["rel_mse"].get<double>(), ratio["ratio"].get<double>(),
                       ratio["low"].get<double>(), ratio["high"].get<double>());
        }
    }
}

void run_bench(BenchCommand& command) {
    const BenchPlan plan = make_plan(command);
    std::optional<ReportInput> old;
    if (!command.compare.empty()) old = load_results(command.compare);
    create_folder(command.out);
    Json results = {{"format", RESULTS_FORMAT}, {"version", RESULTS_VERSION}, {"kind", "bench"}};
    results["tarn"] = describe_build();
    results["settings"] = describe_plan(command, plan);
    Json machine, scenes = Json::array();
    std::vector<WorkFolder> works;
    for (const std::string& scene : command.scenes) {
        scenes.push_back(bench_scene(command, plan, scene, machine, works));
        print_scene(scenes.back());
        print_equal_time(scenes.back());
    }
    results["machine"] = machine;
    results["scenes"] = std::move(scenes);
    const std::filesystem::path out = command.out;
    if (old) results["comparison"] = compare_results(old->results, results, command.compare);
    write_json(out / "results.json", results);
    write_report(out / "report.html", {{results, out}});
    if (!command.options.json_file.empty()) write_json(command.options.json_file, results);
    for (const WorkFolder& work : works) work.remove();
    std::error_code ignored;
    std::filesystem::remove(out / "unfinished", ignored);
    if (old) print_comparison(results["comparison"]);
    fmt::print("\nThe report is {}\n", std::filesystem::absolute(out / "report.html").string());
}

void check_frames(const BenchCommand& command) {
    if (!std::has_single_bit(unsigned(command.frames))) {
        throw CLI::ValidationError("--frames", fmt::format("{} is not a power of two", command.frames));
    }
}

}  // namespace

void add_bench_command(CLI::App& app) {
    auto command = std::make_shared<BenchCommand>();
    CLI::App* sub = app.add_subcommand("bench", "Compare methods: error against time, bias apart from noise");
    command->options.scene.width = 320;
    command->options.scene.height = 180;
    command->methods = default_method_names();
    add_session_options(*sub, command->options);
    // Scenes may be several.
    sub->remove_option(sub->get_option("SCENE"));
    sub->add_option("SCENE", command->scenes, "glTF files or generated scenes")->capture_default_str();
    sub->add_option("--methods", command->methods,
                    "Methods to compare: NAME[:setting=value[,setting=value]], separated by commas")
        ->capture_default_str();
    sub->add_option("--budgets", command->budgets_ms,
                    "Equal times to compare at, ms, separated by commas; 0: none")
        ->delimiter(',')
        ->check(make_finite_range(0.0, 1e6))
        ->capture_default_str();
    sub->add_option("--seeds", command->seeds, "Independent seeds a method")
        ->check(CLI::Range(3, 1000))
        ->capture_default_str();
    sub->add_option("--frames", command->frames, "Frames of the convergence curves, a power of two")
        ->check(CLI::Range(2, MAX_FRAMES))
        ->capture_default_str();
    sub->add_option(
           "--warm-up", command->warm_up_frames,
           "Frames that fill the history of methods that have one and do not count; -1: as many as needed")
        ->check(CLI::Range(-1, MAX_FRAMES))
        ->capture_default_str();
    sub->add_option(
           "--walk", command->walk_m_per_s,
           "The camera moves to its right at this speed, m/s at 60 frames a second; only the frame after the "
           "warm-up counts")
        ->capture_default_str();
    sub->add_option("--turn", command->turn_deg_per_s,
                    "The camera turns left at this speed, degrees a second")
        ->capture_default_str();
    sub->add_option("--reference-spp", command->reference_spp, "Samples a pixel of the reference")
        ->check(CLI::Range(2, 1000000))
        ->capture_default_str();
    sub->add_option("--out", command->out, "Folder for results.json, the page and its pictures")
        ->capture_default_str();
    sub->add_option(
        "--compare", command->compare,
        "results.json of an earlier run: tell what became faster, slower, better or worse beyond the noise");
    sub->callback([command] {
        check_frames(*command);
        run_bench(*command);
    });
}

}  // namespace tarn
