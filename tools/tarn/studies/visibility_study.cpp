// tarn study visibility: the findings of Tokuyoshi's supplement ("Efficient Visibility Reuse for Real-time
// ReSTIR") on a scene of ours. How much less noise has the visibility term when it is averaged instead of
// reused, the samples being the same? How large is the colour leak that averaging adds, beside the darkening
// that both have?
#include <cmath>

#include "core/display.h"
#include "core/error.h"
#include "core/log.h"
#include "find_truth.h"
#include "image_io/image_io.h"
#include "metrics/bias_variance.h"
#include "studies/study.h"

namespace tarn {
namespace {

using Json = nlohmann::ordered_json;

struct VisibilityStudy {
    RenderOptions options;
    int seeds = 6;
    int warm_up = 24;
    int frames = 256;
    int reference_spp = 8192;
    std::string out = "out/study_visibility";
};

// A way to know the visibility of the chosen sample.
struct Mode {
    const char* label;
    FinalVisibility visibility;
    bool visibility_reuse;  // before anyone reuses them: what darkens
    bool per_channel;
    SampleShading shade = SampleShading::CHOSEN;
};

constexpr Mode MODES[] = {
    {"reuse", FinalVisibility::REUSED, true, false},
    {"averaged", FinalVisibility::AVERAGED, true, false},
    {"reuse, per channel", FinalVisibility::REUSED, true, true},
    {"averaged, per channel", FinalVisibility::AVERAGED, true, true},
    {"reuse, all kept", FinalVisibility::REUSED, false, false},
    {"averaged, all kept", FinalVisibility::AVERAGED, false, false},
    {"averaged, all kept, per channel", FinalVisibility::AVERAGED, false, true},
    {"all shaded, all kept", FinalVisibility::AVERAGED, false, false, SampleShading::ALL},
};
constexpr std::size_t REUSE = 0, AVERAGED = 1, REUSE_PER_CHANNEL = 2, AVERAGED_PER_CHANNEL = 3;

// What is seen of a mode, one of each a seed.
struct ModeImages {
    std::vector<Image> terms;       // the visibility term of one frame
    std::vector<Image> unshadowed;  // f(X) W_X of the frame after it
    std::vector<Image> means;       // light, the mean of all further frames
};

RenderSettings settings_of(const VisibilityStudy& study, const Mode& mode) {
    RenderSettings settings = study.options.settings;
    settings.direct.reuse.final_visibility = mode.visibility;
    settings.direct.reuse.visibility_reuse = mode.visibility_reuse;
    settings.direct.per_channel = mode.per_channel;
    settings.direct.reuse.shade = mode.shade;
    return settings;
}

void measure_seed(Renderer& renderer, const StudySequence& sequence, ModeImages& images) {
    constexpr int TERM_FRAME = 0, UNSHADOWED_FRAME = 1, LIGHT_FRAMES = 2;
    FrameMean light;
    StudySequence looked_at = sequence;
    looked_at.frames += LIGHT_FRAMES;
    looked_at.settings.direct.debug_view = DebugView::VISIBILITY;
    render_sequence(renderer, looked_at, [&](int frame, const FrameOutput& output, RenderSettings& next) {
        const Image radiance = renderer.read_radiance(output.radiance);
        if (frame == TERM_FRAME) images.terms.push_back(radiance);
        if (frame == UNSHADOWED_FRAME) images.unshadowed.push_back(radiance);
        if (frame >= LIGHT_FRAMES) light.add(radiance);
        next.direct.debug_view = frame == TERM_FRAME ? DebugView::UNSHADOWED : DebugView::NONE;
    });
    images.means.push_back(light.mean());
}

// All modes, seed by seed.
std::vector<ModeImages> measure_modes(const VisibilityStudy& study, RenderSession& session,
                                      const CameraRecord& camera) {
    std::vector<ModeImages> modes(std::size(MODES));
    Progress progress("studying visibility", std::uint64_t(study.seeds) * std::size(MODES));
    std::uint64_t done = 0;
    for (int k = 0; k < study.seeds; ++k) {
        for (std::size_t m = 0; m < modes.size(); ++m) {
            StudySequence sequence;
            sequence.settings = settings_of(study, MODES[m]);
            sequence.camera = camera;
            sequence.seed = study.options.scene.seed + std::uint32_t(k);
            sequence.warm_up = study.warm_up;
            sequence.frames = study.frames;
            measure_seed(session.renderer(), sequence, modes[m]);
            progress.update(++done);
        }
    }
    return modes;
}

// Share of the pixels in which both chose the same samples with the same weights, over all seeds.
double share_of_same_samples(const ModeImages& a, const ModeImages& b) {
    std::size_t same = 0, pixels = 0;
    for (std::size_t k = 0; k < a.unshadowed.size(); ++k) {
        const Image &first = a.unshadowed[k], &second = b.unshadowed[k];
        for (std::size_t i = 0; i < first.pixel_count(); ++i) {
            same += std::equal(&first.values[3 * i], &first.values[3 * i] + 3, &second.values[3 * i]);
            ++pixels;
        }
    }
    return double(same) / double(pixels);
}

// RMSPE of converged images: 100 sqrt(mean ((b - a) / (a + 0.01))^2), what is left of noise in the mean of
// the seeds and in the reference taken off.
class ConvergedError {
  public:
    explicit ConvergedError(const Truth& truth)
        : truth_(truth.radiance), reference_variance_(truth.variance) {
        const float scale = std::exp2(truth.exposure_ev);
        for (const float value : truth_.values) {
            weights_.push_back(scale / (scale * std::abs(value) + float(REL_MSE_EPSILON)));
        }
        weigh(truth_);
        weigh(reference_variance_);
        weigh(reference_variance_);
    }

    void add(const std::vector<Image>& means) {
        weighted_.emplace_back(means);
        for (Image& image : weighted_.back()) weigh(image);
    }

    // In per cent, of mode number `mode` without seed `left_out`.
    double compute(std::size_t mode, std::size_t left_out) const {
        std::vector<Image> images;
        for (std::size_t k = 0; k < weighted_[mode].size(); ++k) {
            if (k != left_out) images.push_back(weighted_[mode][k]);
        }
        const BiasVariance split =
            split_bias_variance(truth_, images, mean_finite_value(reference_variance_));
        return 100.0 * std::sqrt(std::max(0.0, split.bias_squared));
    }

  private:
    void weigh(Image& image) const {
        for (std::size_t i = 0; i < weights_.size(); ++i) image.values[i] *= weights_[i];
    }

    Image truth_;
    Image reference_variance_;
    std::vector<float> weights_;
    std::vector<std::vector<Image>> weighted_;
};

// Radiance over that of the truth, where the truth counts.
double energy_of(const Truth& truth, const std::vector<Image>& means, std::size_t left_out) {
    double sum = 0.0, expected = 0.0;
    for (std::size_t k = 0; k < means.size(); ++k) {
        if (k == left_out) continue;
        for (std::size_t i = 0; i < truth.radiance.values.size(); ++i) {
            if (!std::isfinite(truth.radiance.values[i])) continue;
            sum += means[k].values[i];
            expected += truth.radiance.values[i];
        }
    }
    return sum / expected;
}

void write_pictures(const VisibilityStudy& study, const Truth& truth, const std::vector<ModeImages>& modes) {
    const std::filesystem::path out = study.out;
    for (const std::size_t m : {REUSE, AVERAGED}) {
        const std::string stem = MODES[m].label;
        write_png(out / ("visibility_" + stem + ".png"), modes[m].terms.front());
        write_png(out / ("converged_" + stem + ".png"),
                  display_from_radiance(modes[m].means.front(), truth.exposure_ev));
    }
    write_png(out / "unshadowed.png",
              display_from_radiance(modes[AVERAGED].unshadowed.front(), truth.exposure_ev));
    write_png(out / "reference.png", display_from_radiance(truth.picture, truth.exposure_ev));
}

Json report_noise(const std::vector<ModeImages>& modes) {
    const ModeImages &reuse = modes[REUSE], &averaged = modes[AVERAGED];
    const double same = share_of_same_samples(reuse, averaged);
    const Estimate ratio = estimate_jackknife(reuse.terms.size(), [&](std::size_t left_out) {
        return mean_variance(averaged.terms, left_out) / mean_variance(reuse.terms, left_out);
    });
    fmt::print("Both chose the same samples in {:.3f} % of the pixels.\n", 100.0 * same);
    fmt::print("Variance of the visibility term, averaged over reuse: {}\n\n", format_estimate(ratio, 3));
    return {{"same_samples", same}, {"variance_ratio", describe_estimate(ratio)}};
}

// How much further off averaging is, in points of RMSPE. Paired: both have the same samples.
Json report_leak(const ConvergedError& error, std::size_t seeds, const char* label, std::size_t averaged,
                 std::size_t reuse) {
    const Estimate leak = estimate_jackknife(seeds, [&](std::size_t left_out) {
        return error.compute(averaged, left_out) - error.compute(reuse, left_out);
    });
    fmt::print("{:<34} {:>28} points of RMSPE\n", label, format_estimate(leak, 2));
    return describe_estimate(leak);
}

Json report_converged(const Truth& truth, const std::vector<ModeImages>& modes) {
    ConvergedError error(truth);
    for (const ModeImages& mode : modes) error.add(mode.means);
    const std::size_t seeds = modes.front().means.size();
    Json rows = Json::array();
    fmt::print("{:<34} {:>28} {:>28}\n", "converged", "RMSPE [%] (95 %)", "energy (95 %)");
    for (std::size_t m = 0; m < modes.size(); ++m) {
        const Estimate rmspe =
            estimate_jackknife(seeds, [&](std::size_t left_out) { return error.compute(m, left_out); });
        const Estimate energy = estimate_jackknife(
            seeds, [&](std::size_t left_out) { return energy_of(truth, modes[m].means, left_out); });
        fmt::print("{:<34} {:>28} {:>28}\n", MODES[m].label, format_estimate(rmspe, 2),
                   format_estimate(energy, 4));
        rows.push_back({{"mode", MODES[m].label},
                        {"rmspe", describe_estimate(rmspe)},
                        {"energy", describe_estimate(energy)}});
    }
    fmt::print("\n");
    Json json = {{"modes", rows}};
    json["averaged_minus_reuse"] = report_leak(error, seeds, "averaged - reuse", AVERAGED, REUSE);
    json["averaged_minus_reuse_per_channel"] =
        report_leak(error, seeds, "averaged - reuse, per channel", AVERAGED_PER_CHANNEL, REUSE_PER_CHANNEL);
    return json;
}

void run(const VisibilityStudy& study) {
    check_output_folder(study.options.json_file);
    if (!study.options.settings.direct.reuses()) {
        throw Error("study visibility: needs --direct restir with --reuse, or a preset of it");
    }
    create_folder(study.out);
    RenderSession session(study.options);
    const CameraRecord camera =
        choose_camera(study.options.scene, session.loaded().scene, session.loaded().world);
    const Truth truth = find_truth(session, study.options,
                                   truth_settings(study.options.scene.width, study.options.scene.height,
                                                  camera, study.reference_spp, 1));
    const std::vector<ModeImages> modes = measure_modes(study, session, camera);
    fmt::print("{}: {} seeds of {} frames after {}, reference of {} samples a pixel\n",
               study.options.scene.scene.stem().string(), study.seeds, study.frames, study.warm_up,
               truth.spp);
    Json json = {{"study", "visibility"}, {"machine", session.describe_machine()}};
    json["seeds"] = study.seeds;
    json["warm_up"] = study.warm_up;
    json["frames"] = study.frames;
    json["reference_spp"] = truth.spp;
    json["noise"] = report_noise(modes);
    json["converged"] = report_converged(truth, modes);
    write_pictures(study, truth, modes);
    write_json(std::filesystem::path(study.out) / "study.json", json);
    if (!study.options.json_file.empty()) write_json(study.options.json_file, json);
    fmt::print("Pictures and study.json are in {}\n", std::filesystem::absolute(study.out).string());
}

}  // namespace

void add_visibility_study(CLI::App& app) {
    auto study = std::make_shared<VisibilityStudy>();
    CLI::App* sub = app.add_subcommand(
        "visibility", "Visibility reused or averaged: noise of the term, darkening, colour leak");
    study->options.scene.scene = "tinted_lights";
    study->options.scene.width = 128;
    study->options.scene.height = 72;
    // As in the paper: the next frame reuses the result of spatial reuse.
    study->options.settings = find_preset("fast").settings;
    study->options.settings.direct.reuse.feedback = true;
    study->options.settings.direct.reuse.radius_px = 30.0;
    add_render_options(*sub, study->options);
    sub->get_option("SCENE")->required(false);
    sub->add_option("--seeds", study->seeds, "Independent seeds")
        ->check(CLI::Range(4, 1000))
        ->capture_default_str();
    sub->add_option("--warm-up", study->warm_up, "Frames that fill the history")
        ->check(CLI::Range(1, 4096))
        ->capture_default_str();
    sub->add_option("--frames", study->frames, "Frames of each seed's converged image")
        ->check(CLI::Range(1, 100000))
        ->capture_default_str();
    sub->add_option("--reference-spp", study->reference_spp, "Samples a pixel of the reference")
        ->check(CLI::Range(2, 1000000))
        ->capture_default_str();
    sub->add_option("--out", study->out, "Folder for the pictures and study.json")->capture_default_str();
    sub->callback([study] { run(*study); });
}

}  // namespace tarn
