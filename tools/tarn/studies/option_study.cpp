// tarn study options: what each optional technique of ReSTIR does to the picture's energy and to its noise.
#include "core/error.h"
#include "core/log.h"
#include "studies/study.h"

namespace tarn {
namespace {

using Json = nlohmann::ordered_json;

struct OptionStudy {
    RenderOptions options;
    int seeds = 8;
    int warm_up = 24;
    int frames = 16;
};

// One option, switched on.
struct Trick {
    const char* setting;
    const char* value;
};

constexpr Trick TRICKS[] = {
    {"permute", "on"},          {"mirror", "on"},  {"boiling-filter", "10"},        {"boiling-filter", "4"},
    {"visibility-reuse", "on"}, {"age-cap", "30"}, {"final-visibility", "averaged"}};

// All seeds of one variant: the mean of some frames for the energy, single frames for the noise.
struct Variant {
    std::vector<Image> means;
    std::vector<Image> lasts;
};

Variant measure(RenderSession& session, const OptionStudy& study, const StudySequence& base,
                const RenderSettings& settings) {
    Variant variant;
    for (int k = 0; k < study.seeds; ++k) {
        StudySequence sequence = base;
        sequence.settings = settings;
        sequence.seed += std::uint32_t(k);
        FrameMean mean;
        Image last;
        Renderer& renderer = session.renderer();
        render_sequence(renderer, sequence, [&](int, const FrameOutput& output, RenderSettings&) {
            last = renderer.read_radiance(output.radiance);
            mean.add(last);
        });
        variant.means.push_back(mean.mean());
        variant.lasts.push_back(std::move(last));
    }
    return variant;
}

Estimate ratio_of(const std::vector<Image>& with, const std::vector<Image>& without,
                  double (*statistic)(const std::vector<Image>&, std::size_t)) {
    return estimate_jackknife(with.size(), [&](std::size_t left_out) {
        return statistic(with, left_out) / statistic(without, left_out);
    });
}

RenderSettings switch_off(RenderSettings settings) {
    settings.direct.reuse.permute = settings.direct.reuse.mirror = settings.direct.reuse.visibility_reuse =
        false;
    settings.direct.reuse.boiling_filter = 0.0;
    settings.direct.reuse.age_cap = 0;
    settings.direct.reuse.final_visibility = FinalVisibility::TRACED;
    return settings;
}

void run(const OptionStudy& study) {
    check_output_folder(study.options.json_file);
    if (!study.options.settings.direct.reuses_time() || !study.options.settings.direct.reuses_space()) {
        throw Error("study options: needs --direct restir with --reuse spatiotemporal, or a preset of it");
    }
    RenderSession session(study.options);
    StudySequence base;
    base.camera = choose_camera(study.options.scene, session.loaded().scene, session.loaded().world);
    base.seed = study.options.scene.seed;
    base.warm_up = study.warm_up;
    base.frames = study.frames;
    Progress progress("studying options", std::size(TRICKS) + 1);
    const RenderSettings plain = switch_off(study.options.settings);
    const Variant without = measure(session, study, base, plain);
    Json rows = Json::array();
    fmt::print("{:<24} {:>34} {:>32}\n", "option", "energy that it adds [%]",
               "variance of a frame, on / off");
    std::uint64_t done = 1;
    for (const Trick& trick : TRICKS) {
        progress.update(done++);
        RenderSettings settings = plain;
        for (const Setting& setting : setting_table()) {
            if (setting.name == trick.setting) setting.parse(settings, trick.value);
        }
        const Variant with = measure(session, study, base, settings);
        const Estimate ratio = ratio_of(with.means, without.means, mean_value);
        const Estimate added{100.0 * (ratio.mean - 1.0), 100.0 * (ratio.low - 1.0),
                             100.0 * (ratio.high - 1.0)};
        const Estimate noise = ratio_of(with.lasts, without.lasts, mean_variance);
        fmt::print("{:<24} {:>34} {:>32}\n", fmt::format("{} {}", trick.setting, trick.value),
                   format_estimate(added, 3), format_estimate(noise, 3));
        rows.push_back({{"setting", trick.setting},
                        {"value", trick.value},
                        {"energy_added_percent", describe_estimate(added)},
                        {"variance_ratio", describe_estimate(noise)}});
    }
    progress.update(done);
    if (study.options.json_file.empty()) return;
    write_json(study.options.json_file, {{"study", "options"},
                                         {"machine", session.describe_machine()},
                                         {"seeds", study.seeds},
                                         {"warm_up", study.warm_up},
                                         {"frames", study.frames},
                                         {"options", rows}});
}

}  // namespace

void add_option_study(CLI::App& app) {
    auto study = std::make_shared<OptionStudy>();
    CLI::App* sub = app.add_subcommand(
        "options", "What permutation, mirroring, the boiling filter and the like do to energy and noise");
    study->options.scene.scene = "lantern_court";
    study->options.scene.width = 320;
    study->options.scene.height = 180;
    study->options.settings = find_preset("balanced").settings;
    add_render_options(*sub, study->options);
    sub->get_option("SCENE")->required(false);
    sub->add_option("--seeds", study->seeds, "Independent seeds")
        ->check(CLI::Range(3, 1000))
        ->capture_default_str();
    sub->add_option("--warm-up", study->warm_up, "Frames that fill the history")
        ->check(CLI::Range(1, 4096))
        ->capture_default_str();
    sub->add_option("--frames", study->frames, "Frames that are averaged after the warm-up")
        ->check(CLI::Range(1, 4096))
        ->capture_default_str();
    sub->callback([study] { run(*study); });
}

}  // namespace tarn
