#include "session.h"

#include <fmt/ranges.h>

#include <fstream>
#include <thread>

#include "core/error.h"
#include "rays/ray_tracer.h"

namespace tarn {
namespace {

std::string read_cpu_name() {
    std::ifstream cpuinfo("/proc/cpuinfo");
    for (std::string line; std::getline(cpuinfo, line);) {
        if (line.starts_with("model name")) return line.substr(line.find(':') + 2);
    }
    return "unknown";
}

nlohmann::json describe_settings(const RenderOptions& options, const Renderer& renderer) {
    nlohmann::json settings = {{"width", renderer.width_px()},
                               {"height", renderer.height_px()},
                               {"seed", options.scene.seed},
                               {"context", options.context}};
    for (const Setting& setting : setting_table()) {
        if (setting.choices.empty()) {
            settings[setting.name] = setting.get(options.settings);
        } else {
            settings[setting.name] = setting.format(options.settings);
        }
    }
    return settings;
}

// Added before the settings themselves: CLI11 calls back in the order of addition, so that a setting changes
// the preset and never the other way round.
void add_preset_option(CLI::App& command, RenderOptions& options) {
    std::string sentence = "Start from a named set of settings";
    for (const Preset& preset : preset_table()) {
        sentence += fmt::format("{}{}: {}", &preset == preset_table().data() ? " [" : "; ", preset.name,
                                preset.describe());
    }
    const auto apply = [&options](const std::string& name) {
        try {
            options.settings = find_preset(name).settings;
            options.preset = name;
            options.names_preset = true;
        } catch (const Error& error) {
            throw CLI::ValidationError(error.what());
        }
    };
    command.add_option_function<std::string>("--preset", apply, sentence + "]");
}

std::string describe_choices(const Setting& setting) {
    if (setting.choices.empty()) return fmt::format(" [{} to {}]", setting.minimum, setting.maximum);
    return fmt::format(" [{}]", fmt::join(setting.choices, ", "));
}

void add_setting_option(CLI::App& command, RenderOptions& options, const Setting& setting) {
    const auto parse = [&options, &setting](const std::string& text) {
        try {
            setting.parse(options.settings, text);
        } catch (const Error& error) {
            throw CLI::ValidationError(error.what());
        }
    };
    command
        .add_option_function<std::string>("--" + setting.name, parse,
                                          setting.sentence + describe_choices(setting))
        ->default_str(setting.format(options.settings));
}

}  // namespace

void add_session_options(CLI::App& command, RenderOptions& options) {
    add_scene_options(command, options.scene);
    command.add_option("--context", options.context, "Where GL comes from [egl, glfw, osmesa]")
        ->check(CLI::IsMember({"egl", "glfw", "osmesa"}))
        ->capture_default_str();
    command
        .add_option("--exposure", options.exposure_ev, "Exposure of PNG pictures, EV (default: automatic)")
        ->check(make_finite_range(MIN_EXPOSURE_EV, MAX_EXPOSURE_EV));
    command.add_option("--json", options.json_file, "Write timings, counters and settings to this file");
}

namespace {

void add_setting_options(CLI::App& command, RenderOptions& options) {
    for (const Setting& setting : setting_table()) add_setting_option(command, options, setting);
}

// As --preset: before the settings.
void add_raw_option(CLI::App& command, RenderOptions& options) {
    const auto apply = [&options](std::int64_t) {
        options.settings = RenderSettings();
        options.preset = "raw";
        options.names_preset = true;
    };
    command.add_flag_function(
        "--raw", apply, "Show the estimator itself: direct light by RIS, no denoiser; not preset clean");
}

void add_look_options(CLI::App& command, RenderOptions& options) {
    const auto parse_tone = [&options](const std::string& name) {
        try {
            options.look.tone = parse_tone_curve(name);
        } catch (const Error& error) {
            throw CLI::ValidationError(error.what());
        }
    };
    command
        .add_option_function<std::string>("--tone", parse_tone,
                                          fmt::format("How pictures for the eye treat what is brighter than "
                                                      "the screen's white [{}]",
                                                      fmt::join(tone_curve_names(), ", ")))
        ->default_str("neutral");
    command
        .add_option(
            "--glare-strength", options.look.glare,
            "Light that scatters around what is brighter than white [0 to 8; 1: as much as in an eye]")
        ->check(make_finite_range(0.0, MAX_GLARE_STRENGTH))
        ->capture_default_str();
    const auto switch_glare = [&options](const std::string& word) {
        if (word == "off") options.look.glare = 0.0f;
    };
    command
        .add_option_function<std::string>("--glare", switch_glare,
                                          "Whether pictures for the eye have glare [off, on]")
        ->check(CLI::IsMember({"off", "on"}))
        ->default_str("on");
}

}  // namespace

void add_render_options(CLI::App& command, RenderOptions& options) {
    add_session_options(command, options);
    add_preset_option(command, options);
    add_setting_options(command, options);
}

void add_picture_options(CLI::App& command, RenderOptions& options) {
    options.settings = find_preset("clean").settings;
    add_session_options(command, options);
    add_preset_option(command, options);
    command.get_option("--preset")->default_str("clean");
    add_raw_option(command, options);
    add_setting_options(command, options);
    add_look_options(command, options);
}

ContextOptions make_context_options(const RenderOptions& options) {
    ContextOptions result;
    result.kind = parse_context_kind(options.context);
    result.gl_threads = options.scene.threads;
    return result;
}

RenderSession::RenderSession(const RenderOptions& options, const SceneEdit& edit)
    : workers_(options.scene.threads),
      loaded_(load_scene(options.scene, edit)),
      threads_(options.scene.threads) {
    context_ = create_context(make_context_options(options));
    tracer_ = create_embree_tracer(loaded_.world);
    renderer_ =
        std::make_unique<Renderer>(loaded_.world, *tracer_, options.scene.width, options.scene.height);
}

void RenderSession::move_to(double time_s) {
    update_world(loaded_.world, loaded_.scene, time_s);
    tracer_->update(loaded_.world);
    renderer_->update();
}

nlohmann::json RenderSession::describe_machine() const {
    const DeviceInfo& device = context_->device_info();
    return {{"cpu", read_cpu_name()},
            {"cores", std::thread::hardware_concurrency()},
            {"threads", threads_ > 0 ? threads_ : int(std::thread::hardware_concurrency())},
            {"gl_renderer", device.renderer},
            {"mesa", device.mesa_version},
            {"embree", describe_ray_library()}};
}

void RunTotals::add(const FrameOutput& output) {
    if (frames == 1) timings = TimingLog();
    timings.add(output.timings);
    shadow_rays += output.shadow_rays.traced;
    closest_rays += output.closest_rays;
    ++frames;
}

nlohmann::json make_report(const RenderOptions& options, RenderSession& session, const RunTotals& totals) {
    nlohmann::json passes = nlohmann::json::array();
    for (const PassTiming& pass : totals.timings.pass_medians()) {
        passes.push_back({{"name", pass.name}, {"ms_median", pass.ms}});
    }
    const FramePlan& frame_plan = session.renderer().plan();
    nlohmann::json plan = nlohmann::json::array();
    for (const FeatureReason& entry : frame_plan.feature_reasons) {
        plan.push_back({{"define", entry.define}, {"reason", entry.reason}});
    }
    for (const PlannedPass& pass : frame_plan.passes) {
        if (pass.runs) plan.push_back({{"pass", pass.name}, {"reason", pass.reason}});
    }
    const double p50 = totals.timings.frame_quantile_ms(0.5), p95 = totals.timings.frame_quantile_ms(0.95);
    return {{"frame_ms", {{"median", p50}, {"p95", p95}, {"frames", totals.timings.frame_count()}}},
            {"passes", passes},
            {"rays", {{"shadow", totals.shadow_rays}, {"closest", totals.closest_rays}}},
            {"counters", session.renderer().read_counters()},
            {"machine", session.describe_machine()},
            {"settings", describe_settings(options, session.renderer())},
            {"plan", plan}};
}

}  // namespace tarn
