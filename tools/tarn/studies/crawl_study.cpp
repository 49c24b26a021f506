// tarn study crawl: how much edges and fine texture crawl while the camera walks slowly. What a picture over
// a path has that no picture of enough samples has: the second difference over time of what is shown, pixel
// by pixel, beside that of the reference with many samples all over each pixel.
#include <cmath>

#include "bench/file_names.h"
#include "bench/method.h"
#include "core/display.h"
#include "core/error.h"
#include "core/log.h"
#include "find_truth.h"
#include "image_io/image_io.h"
#include "interrupt.h"
#include "metrics/flip.h"
#include "renderer_source.h"
#include "studies/study.h"

namespace tarn {
namespace {

using Json = nlohmann::ordered_json;

struct CrawlStudy {
    RenderOptions options;
    std::string methods = "clean:antialias=off,clean,clean:scale=0.5";
    double walk_mm = 3.0;
    int warm_up = 24;
    int frames = 12;
    int reference_spp = 256;
    std::string pictures;  // folder for the last pictures; empty: none
};

// Mean over pixels, channels and frames of |a - 2 b + c|, of display-encoded values in 0..1.
double second_difference(const std::vector<Image>& pictures) {
    double sum = 0.0;
    std::uint64_t count = 0;
    for (std::size_t f = 2; f < pictures.size(); ++f) {
        for (std::size_t i = 0; i < pictures[f].values.size(); ++i) {
            sum += std::abs(double(pictures[f - 2].values[i]) - 2.0 * double(pictures[f - 1].values[i]) +
                            double(pictures[f].values[i]));
            ++count;
        }
    }
    return sum / double(count);
}

class Crawl {
  public:
    Crawl(const CrawlStudy& study, RenderSession& session)
        : study_(study),
          session_(session),
          arrived_(choose_camera(study.options.scene, session.loaded().scene, session.loaded().world)) {}

    std::vector<Image> render_reference(int bounces) {
        std::vector<Image> pictures;
        for (int frame = 0; frame < study_.frames; ++frame) {
            ReferenceSettings settings =
                truth_settings(session_.renderer().width_px(), session_.renderer().height_px(),
                               camera_at(frame), study_.reference_spp, bounces);
            settings.box_pixel_filter = true;
            const ReferenceResult result = find_reference(session_, settings);
            if (result.cancelled) throw Error("interrupted");
            if (!exposure_ev_)
                exposure_ev_ = study_.options.exposure_ev.value_or(auto_exposure_ev(result.radiance));
            pictures.push_back(display_from_radiance(result.radiance, *exposure_ev_));
        }
        keep_picture("reference", pictures.back());
        return pictures;
    }

    std::vector<Image> render(const Method& method, double& frame_ms) {
        std::vector<Image> pictures;
        FrameInput input;
        input.settings = method.settings;
        input.seed = study_.options.scene.seed;
        session_.renderer().reset_history();
        TimingLog timings;
        for (int frame = -study_.warm_up; frame < study_.frames; ++frame) {
            if (interrupt_flag()) throw Error("interrupted; nothing is kept of a study that did not end");
            input.frame = std::uint32_t(frame + study_.warm_up);
            input.camera = camera_at(frame);
            const FrameOutput output = session_.renderer().render(input);
            if (frame < 0) continue;
            timings.add(output.timings);
            pictures.push_back(
                display_from_radiance(session_.renderer().read_radiance(output.radiance), *exposure_ev_));
        }
        frame_ms = timings.frame_quantile_ms(0.5);
        keep_picture(method.label, pictures.back());
        return pictures;
    }

  private:
    // Arrives with the last frame.
    CameraRecord camera_at(int frame) const {
        return camera_before(arrived_, {1e-3 * study_.walk_mm, 0.0}, study_.frames - 1 - frame);
    }

    void keep_picture(const std::string& label, const Image& picture) const {
        if (study_.pictures.empty()) return;
        create_folder(study_.pictures);
        write_png(std::filesystem::path(study_.pictures) / (file_stem(label) + ".png"), picture);
    }

    const CrawlStudy& study_;
    RenderSession& session_;
    CameraRecord arrived_;
    std::optional<float> exposure_ev_;
};

void run(const CrawlStudy& study) {
    check_output_folder(study.options.json_file);
    const std::vector<Method> methods = parse_methods(study.methods);
    RenderSession session(study.options);
    Crawl crawl(study, session);
    const std::vector<Image> truth = crawl.render_reference(count_bounces(methods));
    const double smooth = second_difference(truth);
    fmt::print("{:<58} {:>16} {:>10} {:>8} {:>8}\n", "method", "2nd difference", "crawling", "FLIP", "ms");
    fmt::print("{:<58} {:>16.5f} {:>10} {:>8} {:>8}\n", "reference", smooth, "", "", "");
    Json rows = Json::array();
    for (const Method& method : methods) {
        double frame_ms = 0.0;
        const std::vector<Image> pictures = crawl.render(method, frame_ms);
        const double rough = second_difference(pictures);
        const double flip = mean_error(compute_ldr_flip(truth.back(), pictures.back()));
        fmt::print("{:<58} {:>16.5f} {:>10.5f} {:>8.4f} {:>8.1f}\n", method.label, rough, rough - smooth,
                   flip, frame_ms);
        rows.push_back({{"method", method.label},
                        {"second_difference", rough},
                        {"crawling", rough - smooth},
                        {"flip", flip},
                        {"frame_ms", frame_ms}});
    }
    if (study.options.json_file.empty()) return;
    write_json(study.options.json_file, {{"study", "crawl"},
                                         {"machine", session.describe_machine()},
                                         {"walk_mm", study.walk_mm},
                                         {"reference_second_difference", smooth},
                                         {"methods", rows}});
}

}  // namespace

void add_crawl_study(CLI::App& app) {
    auto study = std::make_shared<CrawlStudy>();
    CLI::App* sub = app.add_subcommand("crawl", "How much edges and texture crawl while the camera walks");
    study->options.scene.scene = "lantern_court";
    study->options.scene.width = 320;
    study->options.scene.height = 180;
    add_session_options(*sub, study->options);
    sub->get_option("SCENE")->required(false);
    sub->add_option("--methods", study->methods, "Methods, by their names in bench")->capture_default_str();
    sub->add_option("--walk", study->walk_mm, "Step of the camera to its right, mm a frame")
        ->check(make_finite_range(0.0, 1e6))
        ->capture_default_str();
    sub->add_option("--warm-up", study->warm_up, "Frames before those that count")
        ->check(CLI::Range(0, 4096))
        ->capture_default_str();
    sub->add_option("--frames", study->frames, "Frames that count")
        ->check(CLI::Range(3, 4096))
        ->capture_default_str();
    sub->add_option("--reference-spp", study->reference_spp, "Samples a pixel of the reference")
        ->check(CLI::Range(2, 1000000))
        ->capture_default_str();
    sub->add_option("--pictures", study->pictures, "Folder for the last picture of each");
    sub->callback([study] { run(*study); });
}

}  // namespace tarn
