// tarn flythrough: plays a camera path without a window and writes pictures, timings and errors, for one or
// several methods.
#include <filesystem>

#include "bench/hash.h"
#include "bench/report.h"
#include "bench/results.h"
#include "commands.h"
#include "core/error.h"
#include "flight_path.h"
#include "flythrough_results.h"
#include "flythrough_run.h"
#include "gl/shader_source.h"
#include "scene/node_tracks.h"

namespace tarn {
namespace {

using Json = nlohmann::ordered_json;

struct FlythroughCommand {
    RenderOptions options;
    FlightPlan plan;
    std::string methods;    // empty: what the settings say
    std::string path_file;  // empty: the scene's own
    std::string out = "out/flythrough";
};

std::string word_of_direct(const RenderSettings& settings) {
    return find_setting("direct").format(settings);
}

nlohmann::json describe_point(const std::optional<glm::dvec3>& point) {
    if (!point) return nullptr;
    return {point->x, point->y, point->z};
}

nlohmann::json describe_track(const NodeTrack& track) {
    nlohmann::json json = {{"node", track.node}};
    for (const NodeKey& key : track.keys) {
        json["keys"].push_back(
            {key.time_s, describe_point(key.position_ns), describe_point(key.rotation_deg)});
    }
    return json;
}

// Everything that decides what a flight comes to.
nlohmann::json describe_key(const FlythroughCommand& command, const CameraPath& path,
                            RenderSession& session) {
    const FlightPlan& plan = command.plan;
    nlohmann::json key = {{"program", hash_program(get_shader_root())},
                          {"machine", session.describe_machine()},
                          {"world", describe_reference_key(session.loaded().world, {})},
                          {"size", {command.options.scene.width, command.options.scene.height}},
                          {"seed", command.options.scene.seed},
                          {"context", command.options.context},
                          {"plan", {plan.frames, plan.pictures, plan.measured, plan.reference_spp}}};
    if (command.options.exposure_ev) key["exposure_ev"] = *command.options.exposure_ev;
    key["look"] = {command.options.look.tone, command.options.look.glare};
    for (const Method& method : plan.methods)
        key["methods"].push_back({method.label, describe_settings(method.settings)});
    for (const CameraKey& k : path.keys) {
        key["path"].push_back({k.time_s, k.position_ws.x, k.position_ws.y, k.position_ws.z, k.target_ws.x,
                               k.target_ws.y, k.target_ws.z, k.vertical_fov_deg});
    }
    for (const NodeTrack& track : path.tracks) key["tracks"].push_back(describe_track(track));
    return key;
}

// The report of the first method, as `render` writes it.
nlohmann::json make_first_report(const FlythroughCommand& command, RenderSession& session,
                                 const Flight& flight, const Json& described) {
    RunTotals totals;
    for (const FlightFrame& frame : flight.methods.front()) {
        if (totals.frames == 1) totals.timings = TimingLog();
        totals.timings.add(frame.timings);
        totals.shadow_rays += frame.rays;
        ++totals.frames;
    }
    nlohmann::json report = make_report(command.options, session, totals);
    if (!flight.counters.empty()) report["counters"] = flight.counters.front();
    report["errors"] = described["methods"][0]["errors"];
    report["exposure_ev"] = flight.exposure_ev.value_or(0.0f);
    report["interrupted"] = flight.interrupted;
    return report;
}

void write_results(const FlythroughCommand& command, RenderSession& session, const Flight& flight,
                   const CameraPath& path) {
    const std::filesystem::path out = command.out;
    const Json described =
        describe_flight(command.plan, flight, command.options.scene.scene.stem().string(), path.name);
    const nlohmann::json report = make_first_report(command, session, flight, described);
    write_json(out / "report.json", report);
    if (!command.options.json_file.empty()) write_json(command.options.json_file, report);
    Json results = {{"format", RESULTS_FORMAT}, {"version", RESULTS_VERSION}, {"kind", "flythrough"}};
    results["tarn"] = describe_build();
    results["machine"] = session.describe_machine();
    results["flythroughs"] = Json::array({described});
    write_json(out / "results.json", results);
    write_report(out / "report.html", {{results, out}});
}

void run_flythrough(FlythroughCommand& command) {
    SceneOptions& of_scene = command.options.scene;
    std::optional<FlightPath> chosen = find_path_file(command.path_file, of_scene.scene);
    if (chosen && of_scene.scene.empty()) of_scene.scene = chosen->path.scene;
    if (of_scene.scene.empty()) throw Error("{}: names no scene; give one", chosen->origin);
    FlightPlan& plan = command.plan;
    if (command.methods.empty()) {
        plan.methods = {
            {word_of_direct(command.options.settings), "as set", command.options.settings, "", 0}};
    } else {
        plan.methods = parse_methods(command.methods);
    }
    check_output_folder(command.options.json_file);
    create_folder(command.out);
    RenderSession session(command.options, [&](Scene& scene) {
        if (chosen) add_tracks(scene, chosen->path.tracks);
    });
    if (!chosen) {
        chosen = make_flight_path(session.loaded().scene, session.loaded().world,
                                  double(of_scene.width) / of_scene.height);
    }
    const CameraPath& path = chosen->path;
    fmt::print("flying {}\n", chosen->origin);
    const std::filesystem::path out = command.out;
    const WorkFolder work(out / "unfinished", describe_key(command, path, session));
    std::vector<std::unique_ptr<Renderer>> renderers;
    std::vector<Renderer*> pointers;
    for (std::size_t i = 0; i < plan.methods.size(); ++i) {
        renderers.push_back(std::make_unique<Renderer>(session.loaded().world, session.tracer(),
                                                       command.options.scene.width,
                                                       command.options.scene.height));
        pointers.push_back(renderers.back().get());
    }
    const Flight flight = fly(plan, path, command.options, session, pointers, out, work);
    if (flight.methods.front().empty()) throw Error("interrupted before the first frame was done");
    write_results(command, session, flight, path);
    if (!flight.interrupted) {
        work.remove();
        write_video(plan, flight, out, path.duration_s);
    }
    print_flight(plan, flight);
    fmt::print("{} is in {}\n",
               flight.interrupted ? "What is done so far (the same command goes on)" : "The report",
               std::filesystem::absolute(out / "report.html").string());
}

}  // namespace

void add_flythrough_command(CLI::App& app) {
    CLI::App* sub = app.add_subcommand(
        "flythrough", "Play a camera path without a window; write pictures, timings and errors");
    auto command = std::make_shared<FlythroughCommand>();
    add_picture_options(*sub, command->options);
    sub->get_option("SCENE")->required(false)->description(
        "glTF file or generated scene (default: the path's own)");
    // The path says where from and when.
    sub->remove_option(sub->get_option("--camera"));
    sub->remove_option(sub->get_option("--time"));
    sub->add_option(
        "--path", command->path_file,
        "Path of the camera, of lights and objects: a JSON file, or the name of an own path "
        "(default: the scene's own by its name or beside its file, that of an animated camera, or "
        "an orbit)");
    sub->add_option("--out", command->out, "Folder for the pictures and report.json")->capture_default_str();
    sub->add_option("--methods", command->methods,
                    "Methods to compare, by their names in bench (default: the one that the settings give)");
    sub->add_option("--frames", command->plan.frames, "Frames along the path")
        ->check(CLI::Range(1, 1000000))
        ->capture_default_str();
    sub->add_option("--pictures", command->plan.pictures, "How many frames to write as PNG")
        ->check(CLI::Range(0, 1000000))
        ->capture_default_str();
    sub->add_option("--measured", command->plan.measured, "How many frames to measure against the reference")
        ->check(CLI::Range(0, 1000000))
        ->capture_default_str();
    sub->add_option("--reference-spp", command->plan.reference_spp, "Samples a pixel of that reference")
        ->check(CLI::Range(2, 1000000))
        ->capture_default_str();
    sub->callback([command] { run_flythrough(*command); });
}

}  // namespace tarn
