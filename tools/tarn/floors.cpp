// tarn floors: how far each pass of a frame is from what this machine could do at best, in the same run.
#include <algorithm>

#include "bench/method.h"
#include "bench/results.h"
#include "commands.h"
#include "core/error.h"
#include "core/statistics.h"
#include "floor_probes.h"
#include "session.h"

namespace tarn {
namespace {

using Json = nlohmann::ordered_json;

struct FloorsCommand {
    RenderOptions options;
    std::string method;  // empty: what the settings say
    int frames = 15;
};

struct FloorRow {
    std::string name;
    std::string floor;  // what the floor is
    std::vector<double> ms;
    std::vector<double> floor_ms;
    std::size_t bytes_read = 0;
    std::size_t bytes_written = 0;
    bool is_on_cpu = false;
};

FloorRow& find_row(std::vector<FloorRow>& rows, const std::string& name) {
    const auto found =
        std::find_if(rows.begin(), rows.end(), [&](const FloorRow& row) { return row.name == name; });
    if (found != rows.end()) return *found;
    rows.emplace_back();
    rows.back().name = name;
    return rows.back();
}

// What pixels see, whoever finds it.
const std::string SEEN_BY_RASTER = "gbuffer/raster";
const std::string SEEN_BY_RAYS = "gbuffer/rays";

// The frame's passes: those that rasterize are one row, as are those that trace, since their floors are of
// all triangles and all rays.
void add_frame(std::vector<FloorRow>& rows, const FrameTimings& timings) {
    double raster_ms = 0.0, rays_ms = 0.0;
    for (const PassTiming& pass : timings.passes) {
        if (pass.name.starts_with(SEEN_BY_RASTER)) {
            raster_ms += pass.ms;
            continue;
        }
        if (pass.is_on_cpu && pass.name != SEEN_BY_RAYS) {
            rays_ms += pass.ms;
            continue;
        }
        FloorRow& row = find_row(rows, pass.name);
        row.ms.push_back(pass.ms);
        row.bytes_read = pass.bytes_read;
        row.bytes_written = pass.bytes_written;
    }
    if (raster_ms > 0.0) find_row(rows, SEEN_BY_RASTER).ms.push_back(raster_ms);
    FloorRow& rays = find_row(rows, "rays");
    rays.ms.push_back(rays_ms);
    rays.is_on_cpu = true;
    find_row(rows, "frame").ms.push_back(timings.frame_ms);
}

struct Probes {
    BareRays rays;
    BareCameraRays camera_rays;
    BareRaster raster;
    EmptyPass empty;
};

// One round of probes, right after a frame: a busy neighbour slows both alike.
void add_floors(std::vector<FloorRow>& rows, Probes& probes) {
    double sum = 0.0;
    for (FloorRow& row : rows) {
        if (row.name == "frame") continue;
        double ms = 0.0;
        if (row.is_on_cpu) {
            row.floor = "bare Embree, the same rays";
            ms = probes.rays.time_ms();
        } else if (row.name == SEEN_BY_RAYS) {
            row.floor = "bare Embree, a ray a pixel";
            ms = probes.camera_rays.time_ms();
        } else if (row.name == SEEN_BY_RASTER) {
            row.floor = "bare raster, the same triangles";
            ms = probes.raster.time_ms();
        } else {
            const double empty_ms = probes.empty.time_ms(),
                         copy_ms = time_copy_ms(row.bytes_read, row.bytes_written);
            row.floor = fmt::format("{}, {:.1f} MB", empty_ms > copy_ms ? "empty pass" : "copy",
                                    1e-6 * double(row.bytes_read + row.bytes_written));
            ms = std::max(empty_ms, copy_ms);
        }
        row.floor_ms.push_back(ms);
        sum += ms;
    }
    FloorRow& frame = find_row(rows, "frame");
    frame.floor = "the sum of the floors";
    frame.floor_ms.push_back(sum);
}

// The median over frames of frame / floor, not the ratio of medians: both halves met the same machine.
double median_ratio(const FloorRow& row) {
    std::vector<double> ratios;
    for (std::size_t i = 0; i < row.ms.size(); ++i)
        ratios.push_back(row.ms[i] / std::max(row.floor_ms[i], 1e-6));
    return quantile(ratios, 0.5);
}

Json describe(const std::vector<FloorRow>& rows, std::size_t ray_count) {
    Json list = Json::array();
    for (const FloorRow& row : rows) {
        list.push_back({{"name", row.name},
                        {"ms_median", quantile(row.ms, 0.5)},
                        {"floor", row.floor},
                        {"floor_ms_median", quantile(row.floor_ms, 0.5)},
                        {"ratio", median_ratio(row)}});
    }
    return {{"rays", ray_count}, {"passes", list}};
}

void print_table(const Json& floors) {
    fmt::print("{:<26} {:>9} {:>9} {:>7}  {}\n", "pass", "ms", "floor ms", "ratio", "floor");
    for (const Json& row : floors["passes"]) {
        fmt::print("{:<26} {:9.2f} {:9.2f} {:7.2f}  {}\n", row["name"].get<std::string>(),
                   row["ms_median"].get<double>(), row["floor_ms_median"].get<double>(),
                   row["ratio"].get<double>(), row["floor"].get<std::string>());
    }
}

void run_floors(FloorsCommand& command) {
    check_output_folder(command.options.json_file);
    if (!command.method.empty()) command.options.settings = parse_method(command.method).settings;
    RenderSession session(command.options);
    auto& world = session.loaded().world;
    const int width = command.options.scene.width, height = command.options.scene.height;
    FrameInput input;
    input.camera = choose_camera(command.options.scene, session.loaded().scene, world);
    input.seed = command.options.scene.seed;
    input.settings = command.options.settings;

    RayCapture capture(session.tracer());
    Renderer captured(world, capture, width, height);
    const int warm_up_frames =
        command.method.empty() ? 2 : std::max(2, parse_method(command.method).warm_up_frames);
    for (int frame = 0; frame < warm_up_frames; ++frame) {
        capture.take_rays();
        input.frame = std::uint32_t(frame);
        captured.render(input);
        session.renderer().render(input);
    }
    const std::vector<RayRecord> records = capture.take_rays();
    Probes probes{BareRays(world, records), BareCameraRays(world, input.camera, width, height),
                  BareRaster(world, input.camera, width, height), EmptyPass(width, height)};
    probes.raster.time_ms();  // compiles
    probes.empty.time_ms();

    std::vector<FloorRow> rows;
    for (int frame = 0; frame < command.frames; ++frame) {
        input.frame = std::uint32_t(warm_up_frames + frame);
        add_frame(rows, session.renderer().render(input).timings);
        add_floors(rows, probes);
    }
    Json floors = describe(rows, records.size());
    floors["machine"] = session.describe_machine();
    floors["settings"] = describe_settings(command.options.settings);
    print_table(floors);
    if (!command.options.json_file.empty()) write_json(command.options.json_file, floors);
}

}  // namespace

void add_floors_command(CLI::App& app) {
    auto command = std::make_shared<FloorsCommand>();
    CLI::App* sub = app.add_subcommand(
        "floors", "Compare each pass with the least time that this machine could need for it");
    add_render_options(*sub, command->options);
    sub->add_option("--method", command->method,
                    "A method by its name in bench (default: the one that the settings give)");
    sub->add_option("--frames", command->frames, "Frames to measure")
        ->check(CLI::Range(1, 10000))
        ->capture_default_str();
    sub->callback([command] { run_floors(*command); });
}

}  // namespace tarn
