// tarn study lag: how many frames late a method shows a change of the scene. Lights go out and on,
// everything that is animated jumps, the camera cuts; and two numbers for each: frames until nine tenths of
// the change are in the picture, as its mean over seeds shows it, and frames until its noise has settled.
#include "bench/method.h"
#include "core/error.h"
#include "core/log.h"
#include "interrupt.h"
#include "metrics/step_response.h"
#include "renderer_source.h"
#include "studies/study.h"

namespace tarn {
namespace {

using Json = nlohmann::ordered_json;

struct LagStudy {
    RenderOptions options;
    std::string methods = "ris,restir-fast,restir-balanced,restir-unbiased";
    int seeds = 4;
    int warm_up = 32;
    int frames = 48;
};

constexpr double REACHED = 0.9;   // of the change
constexpr double SETTLED = 1.1;   // of the noise in the end
constexpr double JUMP_S = 1.0;    // of the animation
constexpr double CUT_DEG = 15.0;  // that the camera turns
constexpr int FRAMES_BEFORE = 8;  // of the warm-up that show what was before

// What the world is like: of two such states one follows the other at once.
struct WorldState {
    bool half_dark = false;  // every second light and emissive material is out
    double time_s = 0.0;
    double turn_deg = 0.0;
};

struct Step {
    const char* name;
    WorldState before;
    WorldState after;
};

constexpr Step STEPS[] = {
    {"half of the lights go out", {}, {true, 0.0, 0.0}},
    {"they go on again", {true, 0.0, 0.0}, {}},
    {"what is animated jumps", {}, {false, JUMP_S, 0.0}},
    {"the camera cuts", {}, {false, 0.0, CUT_DEG}},
};

// A world that goes from state to state.
class Stage {
  public:
    explicit Stage(RenderSession& session, const CameraRecord& camera) : session_(session), camera_(camera) {
        for (const Material& material : scene().materials) emissions_.push_back(material.emission);
        for (const PunctualLight& light : scene().lights) intensities_.push_back(light.intensity);
    }

    // Returns the camera of the state.
    CameraRecord enter(const WorldState& state) {
        bool dark = false;
        for (std::size_t i = 0; i < emissions_.size(); ++i) {
            if (emissions_[i] == glm::vec3(0.0f)) continue;
            scene().materials[i].emission = dark && state.half_dark ? glm::vec3(0.0f) : emissions_[i];
            dark = !dark;
        }
        for (std::size_t i = 0; i < intensities_.size(); ++i) {
            scene().lights[i].intensity = dark && state.half_dark ? glm::vec3(0.0f) : intensities_[i];
            dark = !dark;
        }
        ++scene().revision;
        session_.move_to(state.time_s);
        return turn_camera(camera_, state.turn_deg);
    }

  private:
    Scene& scene() { return session_.loaded().scene; }

    RenderSession& session_;
    CameraRecord camera_;
    std::vector<glm::vec3> emissions_;
    std::vector<glm::vec3> intensities_;
};

void run_seed(const LagStudy& study, RenderSession& session, Stage& stage, const Step& step,
              const RenderSettings& settings, std::uint32_t seed, StepResponse& response) {
    Renderer& renderer = session.renderer();
    FrameInput input;
    input.settings = settings;
    input.seed = seed;
    input.camera = stage.enter(step.before);
    renderer.reset_history();
    for (int i = 0; i < study.warm_up + study.frames; ++i) {
        if (interrupt_flag()) throw Error("interrupted; nothing is kept of a study that did not end");
        if (i == study.warm_up) input.camera = stage.enter(step.after);
        input.frame = std::uint32_t(i);
        const FrameOutput output = renderer.render(input);
        const int later = i - study.warm_up;
        if (later < -FRAMES_BEFORE) continue;
        const Image radiance = renderer.read_radiance(output.radiance);
        if (later < 0) {
            response.add_before(radiance);
        } else {
            response.add_after(later, radiance);
        }
    }
}

Json describe(const StepResponse& response) {
    const auto reached = response.frames_to_reach(REACHED), settled = response.frames_to_settle(SETTLED);
    Json json;
    json["frames_to_reach"] = reached ? Json(*reached) : Json();
    json["frames_to_settle"] = settled ? Json(*settled) : Json();
    json["progress"] = response.progress();
    json["noise"] = response.noise();
    return json;
}

std::string word_of(const Json& frames, int limit) {
    return frames.is_null() ? fmt::format("> {}", limit) : fmt::format("{}", frames.get<int>());
}

void run(const LagStudy& study) {
    check_output_folder(study.options.json_file);
    const std::vector<Method> methods = parse_methods(study.methods);
    RenderSession session(study.options);
    Stage stage(session, choose_camera(study.options.scene, session.loaded().scene, session.loaded().world));
    Progress progress("studying lag", methods.size() * std::size(STEPS) * std::uint64_t(study.seeds));
    std::uint64_t done = 0;
    Json rows = Json::array();
    for (const Step& step : STEPS) {
        const bool is_jump = step.before.time_s != step.after.time_s;
        if (is_jump && !session.loaded().world.is_animated) continue;
        for (const Method& method : methods) {
            StepResponse response(study.frames);
            for (int k = 0; k < study.seeds; ++k) {
                run_seed(study, session, stage, step, method.settings,
                         study.options.scene.seed + std::uint32_t(k), response);
                progress.update(++done);
            }
            Json row = {{"step", step.name}, {"method", method.label}};
            row.update(describe(response));
            rows.push_back(std::move(row));
        }
    }
    fmt::print("{:<28} {:<28} {:>20} {:>20}\n", "step", "method", "90 % after [frames]",
               "calm after [frames]");
    for (const Json& row : rows) {
        fmt::print("{:<28} {:<28} {:>20} {:>20}\n", row["step"].get<std::string>(),
                   row["method"].get<std::string>(), word_of(row["frames_to_reach"], study.frames),
                   word_of(row["frames_to_settle"], study.frames));
    }
    if (study.options.json_file.empty()) return;
    write_json(study.options.json_file, {{"study", "lag"},
                                         {"machine", session.describe_machine()},
                                         {"seeds", study.seeds},
                                         {"warm_up", study.warm_up},
                                         {"frames", study.frames},
                                         {"steps", rows}});
}

}  // namespace

void add_lag_study(CLI::App& app) {
    auto study = std::make_shared<LagStudy>();
    CLI::App* sub = app.add_subcommand("lag", "How many frames late a method shows a change of the scene");
    study->options.scene.scene = "lantern_court";
    study->options.scene.width = 160;
    study->options.scene.height = 90;
    add_session_options(*sub, study->options);
    sub->get_option("SCENE")->required(false);
    sub->add_option("--methods", study->methods, "Methods, by their names in bench")->capture_default_str();
    sub->add_option("--seeds", study->seeds, "Independent seeds")
        ->check(CLI::Range(1, 1000))
        ->capture_default_str();
    sub->add_option("--warm-up", study->warm_up, "Frames before the change")
        ->check(CLI::Range(FRAMES_BEFORE, 4096))
        ->capture_default_str();
    sub->add_option("--frames", study->frames,
                    "Frames after the change; the second half shows where the method settles")
        ->check(CLI::Range(4, 4096))
        ->capture_default_str();
    sub->callback([study] { run(*study); });
}

}  // namespace tarn
