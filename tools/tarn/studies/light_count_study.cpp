// tarn study lights: what a frame costs as the lights grow from ten to a million, the update of those that
// move included. Points add nothing but light; triangles are geometry too, which the rasterizer draws and
// each ray must pass.
#include <algorithm>
#include <chrono>

#include "content/scenes.h"
#include "core/error.h"
#include "core/log.h"
#include "interrupt.h"
#include "shared/math/random.h"
#include "studies/study.h"

namespace tarn {
namespace {

using Json = nlohmann::ordered_json;

constexpr double FRAMES_PER_S = 60.0;
constexpr int BASE_COUNT = 100;             // what ratios are to
constexpr double DRIFT_M = 0.3;             // how far a moving point comes from its place
constexpr double TOTAL_INTENSITY = 2000.0;  // W/sr of all points together

struct LightCountStudy {
    RenderOptions options;
    std::vector<int> counts = {10, 100, 1000, 10000, 100000, 1000000};
    std::string kind = "points";
    double moving_percent = 1.0;
    int warm_up = 4;
    int frames = 15;
};

double elapsed_ms(const std::function<void()>& work) {
    const auto start = std::chrono::steady_clock::now();
    work();
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}

// A point light that swings along a line.
struct MovingPoint {
    std::size_t node;
    glm::dvec3 place_ws;
    glm::dvec3 direction;
};

// One number of lights: its world, and what its frames took.
struct Crowd {
    int count = 0;
    LoadedScene loaded;
    std::unique_ptr<RayTracer> tracer;
    std::unique_ptr<Renderer> renderer;
    CameraRecord camera{};
    std::vector<MovingPoint> points;
    std::vector<double> update_ms, frame_ms;

    void move_points(double time_s) {
        for (const MovingPoint& point : points) {
            loaded.scene.nodes[point.node].local.translation =
                point.place_ws + DRIFT_M * std::sin(2.0 * time_s) * point.direction;
            loaded.scene.moves.add(NodeIndex(point.node));
        }
    }

    void add_frame(const LightCountStudy& study, int frame) {
        const double time_s = frame / FRAMES_PER_S;
        if (!points.empty()) move_points(time_s);
        const double moved_ms = elapsed_ms([&] {
            update_world(loaded.world, loaded.scene, points.empty() ? time_s : -1.0);
            tracer->update(loaded.world);
            renderer->update();
        });
        loaded.scene.moves.clear();
        FrameInput input;
        input.camera = camera;
        input.frame = std::uint32_t(frame);
        input.seed = study.options.scene.seed;
        input.settings = study.options.settings;
        const FrameTimings timings = renderer->render(input).timings;
        if (frame < study.warm_up) return;
        update_ms.push_back(moved_ms);
        frame_ms.push_back(timings.frame_ms);
    }
    double total_ms(std::size_t frame) const { return update_ms[frame] + frame_ms[frame]; }
};

// Points all over the hall, together as bright as its triangles.
void add_points(const LightCountStudy& study, Crowd& crowd) {
    Scene& scene = crowd.loaded.scene;
    for (Material& material : scene.materials) material.emission = glm::vec3(0.0f);
    PunctualLight light;
    light.intensity = glm::vec3(float(TOTAL_INTENSITY / crowd.count));
    scene.lights.push_back(light);
    const LightIndex index(std::uint32_t(scene.lights.size() - 1));
    const double moving_share = study.moving_percent / 100.0;
    for (int i = 0; i < crowd.count; ++i) {
        const RandomKey key{std::uint32_t(i), 0u, 1u};
        const glm::vec4 place = random4(key, 0u), towards = random4(key, 1u);
        Node node;
        node.local.translation = {38.0 * place.x - 19.0, 0.3 + 3.7 * place.y, 38.0 * place.z - 19.0};
        node.light = index;
        scene.light_nodes.push_back(NodeIndex(std::uint32_t(scene.nodes.size())));
        if (std::floor((i + 1) * moving_share) > std::floor(i * moving_share)) {  // all over the table
            const glm::dvec3 direction = glm::normalize(glm::dvec3(towards) - 0.4999);
            crowd.points.push_back({scene.nodes.size(), node.local.translation, direction});
        }
        scene.nodes.push_back(std::move(node));
    }
    crowd.loaded.world = build_world(scene);
}

void load_crowd(const LightCountStudy& study, const std::filesystem::path& folder, Crowd& crowd) {
    const bool points = study.kind == "points";
    content::SceneOptions options;
    options.count = points ? 1 : crowd.count;
    options.moving_percent = points ? 0.0 : study.moving_percent;
    const std::filesystem::path file = folder / fmt::format("many_lights_{}.glb", crowd.count);
    write_file(file, content::generate_scene("many_lights", options));
    SceneOptions scene = study.options.scene;
    scene.scene = file;
    crowd.loaded = load_scene(scene);
    std::filesystem::remove(file);
    if (points) add_points(study, crowd);
    crowd.tracer = create_embree_tracer(crowd.loaded.world);
    crowd.renderer = std::make_unique<Renderer>(crowd.loaded.world, *crowd.tracer, scene.width, scene.height);
    crowd.camera = choose_camera(scene, crowd.loaded.scene, crowd.loaded.world);
}

// All crowds at once, frame by frame: a busy minute of the machine falls on all alike.
void measure(const LightCountStudy& study, std::vector<Crowd>& crowds) {
    const TemporaryFolder folder;
    Progress loading("loading", crowds.size());
    for (std::size_t i = 0; i < crowds.size(); ++i) {
        if (interrupt_flag()) throw Error("interrupted");
        load_crowd(study, folder.path(), crowds[i]);
        loading.update(i + 1);
    }
    Progress progress("measuring", std::uint64_t(study.warm_up + study.frames));
    for (int frame = 0; frame < study.warm_up + study.frames; ++frame) {
        if (interrupt_flag()) throw Error("interrupted");
        for (Crowd& crowd : crowds) crowd.add_frame(study, frame);
        progress.update(std::uint64_t(frame) + 1);
    }
}

Json report(const LightCountStudy& study, const std::vector<Crowd>& crowds) {
    const auto base = std::find_if(crowds.begin(), crowds.end(),
                                   [](const Crowd& crowd) { return crowd.count == BASE_COUNT; });
    fmt::print("{}, {:g} % of them moving; {} x {}; medians of {} frames\n", study.kind, study.moving_percent,
               study.options.scene.width, study.options.scene.height, study.frames);
    fmt::print("{:>9} {:>9} {:>11} {:>9} {:>9} {:>16}\n", "lights", "in all", "update ms", "frame ms",
               "sum ms", fmt::format("sum / {} lights", BASE_COUNT));
    Json rows = Json::array();
    for (const Crowd& crowd : crowds) {
        std::vector<double> totals, ratios;
        for (std::size_t i = 0; i < crowd.frame_ms.size(); ++i) {
            totals.push_back(crowd.total_ms(i));
            ratios.push_back(base == crowds.end() ? 0.0 : crowd.total_ms(i) / base->total_ms(i));
        }
        const double update = quantile(crowd.update_ms, 0.5), frame = quantile(crowd.frame_ms, 0.5);
        fmt::print("{:>9} {:>9} {:11.2f} {:9.1f} {:9.1f} {:16.3f}\n", crowd.count,
                   crowd.loaded.world.lights.count, update, frame, quantile(totals, 0.5),
                   quantile(ratios, 0.5));
        rows.push_back({{"lights", crowd.count},
                        {"update_ms", update},
                        {"frame_ms", frame},
                        {"sum_ms", quantile(totals, 0.5)},
                        {"ratio", quantile(ratios, 0.5)}});
    }
    return rows;
}

void run(const LightCountStudy& study) {
    check_output_folder(study.options.json_file);
    const WorkerLimit workers(study.options.scene.threads);
    const std::unique_ptr<Context> context = create_context(make_context_options(study.options));
    std::vector<Crowd> crowds(study.counts.size());
    for (std::size_t i = 0; i < crowds.size(); ++i) crowds[i].count = study.counts[i];
    measure(study, crowds);
    const Json rows = report(study, crowds);
    if (study.options.json_file.empty()) return;
    write_json(study.options.json_file, {{"study", "lights"},
                                         {"kind", study.kind},
                                         {"moving_percent", study.moving_percent},
                                         {"counts", rows}});
}

}  // namespace

void add_light_count_study(CLI::App& app) {
    auto study = std::make_shared<LightCountStudy>();
    CLI::App* sub = app.add_subcommand("lights", "What a frame costs with more and more lights");
    study->options.settings = find_preset("fast").settings;
    add_render_options(*sub, study->options);
    sub->remove_option(sub->get_option("SCENE"));
    sub->add_option("--counts", study->counts, "Numbers of lights, separated by commas")
        ->delimiter(',')
        ->check(CLI::Range(1, 1000000))
        ->capture_default_str();
    sub->add_option("--kind", study->kind,
                    "points, or triangles, which the rasterizer draws and rays hit as well")
        ->check(CLI::IsMember({"points", "triangles"}))
        ->capture_default_str();
    sub->add_option("--moving", study->moving_percent, "Percentage of the lights that move")
        ->check(make_finite_range(0.0, 100.0))
        ->capture_default_str();
    sub->add_option("--warm-up", study->warm_up, "Frames before those that count")
        ->check(CLI::Range(1, 4096))
        ->capture_default_str();
    sub->add_option("--frames", study->frames, "Frames that count")
        ->check(CLI::Range(3, 4096))
        ->capture_default_str();
    sub->callback([study] { run(*study); });
}

}  // namespace tarn
