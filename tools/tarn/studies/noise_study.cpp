// tarn study noise: what random numbers of a path's first direction are worth once a filter has run. The
// error of indirect light with white and with blue noise, of single frames, after a box of 5 x 5 pixels and
// after a mean of some frames; and how errors of pixels side by side go together (their autocovariance).
#include <algorithm>
#include <array>

#include "core/statistics.h"
#include "metrics/convolve.h"
#include "metrics/frame_mean.h"
#include "metrics/image_error.h"
#include "shared/math/colour.h"
#include "studies/indirect_runs.h"

namespace tarn {
namespace {

using Json = nlohmann::ordered_json;

struct NoiseStudy {
    RenderOptions options;
    int seeds = 4;
    int frames = 8;
    int reference_spp = 1024;
};

constexpr int BOX_PX = 5;
constexpr std::array<glm::ivec2, 6> LAGS_PX = {{{1, 0}, {0, 1}, {1, 1}, {2, 0}, {0, 2}, {4, 0}}};

Image blur(const Image& image) {
    const Kernel box(BOX_PX, 1.0f / BOX_PX);
    Image result = image;
    for (int channel = 0; channel < image.channels; ++channel) {
        Plane plane(image.width, image.height);
        for (std::size_t i = 0; i < plane.values.size(); ++i)
            plane.values[i] = image.values[i * std::size_t(image.channels) + std::size_t(channel)];
        plane = correlate(plane, box, box);
        for (std::size_t i = 0; i < plane.values.size(); ++i)
            result.values[i * std::size_t(image.channels) + std::size_t(channel)] = plane.values[i];
    }
    return result;
}

// Error of each pixel's luminance over the root of relMSE's denominator, so that dark pixels count too.
Plane find_relative_errors(const Image& truth, const Image& image) {
    Plane errors(truth.width, truth.height);
    for (std::size_t i = 0; i < errors.values.size(); ++i) {
        const auto luminance_of = [&](const Image& of) {
            return luminance(glm::vec3(of.values[3 * i], of.values[3 * i + 1], of.values[3 * i + 2]));
        };
        const float expected = luminance_of(truth);
        errors.values[i] =
            (luminance_of(image) - expected) / std::sqrt(expected * expected + float(REL_MSE_EPSILON));
    }
    return errors;
}

// Sums of products of errors that lie `lag` apart.
struct Autocovariance {
    RunningMoments squares;
    std::array<RunningMoments, LAGS_PX.size()> products;

    void add(const Plane& errors) {
        for (const float e : errors.values) squares.add(double(e) * double(e));
        for (std::size_t k = 0; k < LAGS_PX.size(); ++k) {
            const glm::ivec2 lag = LAGS_PX[k];
            for (int y = 0; y + lag.y < errors.height; ++y) {
                for (int x = 0; x + lag.x < errors.width; ++x)
                    products[k].add(double(errors.row(y)[x]) * double(errors.row(y + lag.y)[x + lag.x]));
            }
        }
    }
};

struct Errors {
    RunningMoments rel_mse, trimmed;
    void add(const Image& truth, const Image& image) {
        const ImageErrors errors = compute_image_errors(truth, image);
        rel_mse.add(errors.rel_mse);
        trimmed.add(errors.rel_mse_trimmed);
    }
    Json describe() const { return {{"rel_mse", rel_mse.mean()}, {"rel_mse_trimmed", trimmed.mean()}}; }
};

struct NoiseErrors {
    Errors single, blurred, mean_blurred;  // the last: of the mean of all frames of a seed
    Autocovariance covariance;
};

NoiseErrors measure(RenderSession& session, const NoiseStudy& study, NoiseKind noise, const Image& truth) {
    const SceneOptions& scene = study.options.scene;
    StudySequence sequence{study.options.settings,
                           choose_camera(scene, session.loaded().scene, session.loaded().world), scene.seed,
                           0, study.frames};
    sequence.settings.indirect.noise = noise;
    const Image blurred_truth = blur(truth);
    NoiseErrors result;
    for (int k = 0; k < study.seeds; ++k, ++sequence.seed) {
        FrameMean mean;
        for (const Image& frame : render_indirect_run(session.renderer(), sequence).frames) {
            result.single.add(truth, frame);
            result.blurred.add(blurred_truth, blur(frame));
            result.covariance.add(find_relative_errors(truth, frame));
            mean.add(frame);
        }
        result.mean_blurred.add(blurred_truth, blur(mean.mean()));
    }
    return result;
}

Json describe(const NoiseErrors& errors) {
    Json json = {{"frame", errors.single.describe()},
                 {"frame_after_box", errors.blurred.describe()},
                 {"mean_of_frames_after_box", errors.mean_blurred.describe()}};
    Json covariances = Json::object();
    for (std::size_t k = 0; k < LAGS_PX.size(); ++k) {
        covariances[fmt::format("{},{}", LAGS_PX[k].x, LAGS_PX[k].y)] =
            errors.covariance.products[k].mean() / errors.covariance.squares.mean();
    }
    json["autocovariance_over_variance"] = covariances;
    return json;
}

void print(const Json& rows) {
    fmt::print("{:<28} {:>10} {:>10} {:>12}\n", "relMSE without the worst 0.1 %", "white", "blue",
               "blue/white");
    const Json &white = rows["white"], &blue = rows["blue"];
    const auto print_row = [](const std::string& name, double a, double b) {
        fmt::print("{:<28} {:>12.5f} {:>10.5f} {:>12.3f}\n", name, a, b, b / a);
    };
    for (const auto& [name, title] :
         {std::pair("frame", "a frame"), std::pair("frame_after_box", "after a box of 5 x 5"),
          std::pair("mean_of_frames_after_box", "mean of frames, box")}) {
        print_row(title, white[name]["rel_mse_trimmed"], blue[name]["rel_mse_trimmed"]);
    }
    fmt::print("autocovariance / variance, pixels apart\n");
    for (const auto& [lag, value] : white["autocovariance_over_variance"].items()) {
        fmt::print("{:<28} {:>12.4f} {:>10.4f}\n", lag, value.get<double>(),
                   blue["autocovariance_over_variance"][lag].get<double>());
    }
}

void run(const NoiseStudy& study) {
    check_output_folder(study.options.json_file);
    const IndirectSettings& indirect = study.options.settings.indirect;
    if (!indirect.runs()) throw Error("study noise: needs --indirect path or restir");
    RenderSession session(study.options);
    const Image truth =
        IndirectReferences(session, study.options.scene, study.reference_spp).find(indirect.bounces);
    Json rows = {{"white", describe(measure(session, study, NoiseKind::WHITE, truth))},
                 {"blue", describe(measure(session, study, NoiseKind::BLUE, truth))}};
    print(rows);
    if (study.options.json_file.empty()) return;
    Json json = {{"study", "noise"},
                 {"machine", session.describe_machine()},
                 {"seeds", study.seeds},
                 {"frames", study.frames}};
    json.update(rows);
    write_json(study.options.json_file, json);
}

}  // namespace

void add_noise_study(CLI::App& app) {
    auto study = std::make_shared<NoiseStudy>();
    CLI::App* sub = app.add_subcommand(
        "noise", "What blue noise of paths is worth beside white, before and after a filter");
    study->options.scene.scene = "cornell";
    study->options.scene.width = 320;
    study->options.scene.height = 180;
    study->options.settings.indirect.mode = IndirectMode::PATH;
    add_render_options(*sub, study->options);
    sub->get_option("SCENE")->required(false);
    const auto add_count = [&](const char* name, int& value, const char* what) {
        sub->add_option(name, value, what)->check(CLI::Range(1, 65536))->capture_default_str();
    };
    add_count("--seeds", study->seeds, "Independent seeds");
    add_count("--frames", study->frames, "Frames of a seed");
    add_count("--reference-spp", study->reference_spp, "Samples per pixel of the references");
    sub->callback([study] { run(*study); });
}

}  // namespace tarn
