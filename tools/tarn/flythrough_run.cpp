#include "flythrough_run.h"

#include <algorithm>
#include <cmath>

#include "bench/file_names.h"
#include "bench/sequence_json.h"
#include "core/display.h"
#include "core/log.h"
#include "find_truth.h"
#include "image_io/image_io.h"
#include "interrupt.h"
#include "silhouettes.h"

namespace tarn {
namespace {

// A flight that goes on repeats so many frames first, to fill the histories as they were.
constexpr int RESUMED_FRAMES = 20;

// Whether `frame` is one of `count` that are spread evenly over `frames`, each in the middle of its stretch.
bool is_chosen(int frame, int frames, int count) {
    const auto stretch = [&](int f) { return (2ll * f * count + frames) / (2ll * frames); };
    return count >= frames || stretch(frame) != stretch(frame - 1);
}

std::string frame_note(int frame) {
    return fmt::format("frame{:06}", frame);
}

nlohmann::json note_of(const FlightFrame& frame) {
    nlohmann::json note = {{"ms", frame.timings.frame_ms}, {"rays", frame.rays}, {"flicker", frame.flicker}};
    note["passes"] = nlohmann::json::array();
    for (const PassTiming& pass : frame.timings.passes) note["passes"].push_back({pass.name, pass.ms});
    if (frame.errors) note["errors"] = *frame.errors;
    return note;
}

FlightFrame read_note(const nlohmann::json& note) {
    FlightFrame frame;
    frame.timings.frame_ms = note.at("ms");
    frame.rays = note.at("rays");
    frame.flicker = note.at("flicker");
    for (const nlohmann::json& pass : note.at("passes"))
        frame.timings.passes.push_back({pass.at(0), pass.at(1)});
    if (note.contains("errors")) frame.errors = note.at("errors").get<PictureErrors>();
    return frame;
}

double mean_absolute_difference(const Image& a, const Image& b) {
    double sum = 0.0;
    for (std::size_t i = 0; i < a.values.size(); ++i)
        sum += std::abs(double(a.values[i]) - double(b.values[i]));
    return sum / double(a.values.size());
}

bool is_empty(const GBuffer& gbuffer) {
    const auto seen = gbuffer.seen->download<glm::uvec2>();
    return std::all_of(seen.begin(), seen.end(), [](const glm::uvec2& s) { return s.x == INVALID_INDEX; });
}

class Flyer {
  public:
    Flyer(const FlightPlan& plan, const CameraPath& path, const RenderOptions& options,
          RenderSession& session, std::vector<Renderer*> renderers, std::filesystem::path out,
          const WorkFolder& work)
        : plan_(plan),
          path_(path),
          options_(options),
          session_(session),
          renderers_(std::move(renderers)),
          out_(std::move(out)),
          work_(work) {
        flight_.methods.resize(plan.methods.size());
        flight_.exposure_ev = flight_.shown_ev = options.exposure_ev;
        const nlohmann::json note = work.load_note("exposure");
        if (note.is_null()) return;
        flight_.exposure_ev = note.at(0).get<float>();
        flight_.shown_ev = note.at(1).get<float>();
    }

    Flight fly() {
        const int done = load_frames();
        for (int frame = std::max(0, done - RESUMED_FRAMES); frame < done; ++frame) {
            move_to(frame);
            for (std::size_t method = 0; method < renderers_.size(); ++method) render(method, frame);
        }
        flight_.counters = earlier_counters_;
        Progress progress("flying", std::uint64_t(plan_.frames));
        for (int frame = done; frame < plan_.frames && !flight_.interrupted; ++frame) {
            fly_frame(frame);
            progress.update(std::uint64_t(frame) + 1);
        }
        return std::move(flight_);
    }

  private:
    bool is_measured(int frame) const { return is_chosen(frame, plan_.frames, plan_.measured); }
    bool is_pictured(int frame) const {
        return is_chosen(frame, plan_.frames, plan_.pictures) || is_measured(frame);
    }

    // How many frames an earlier run finished.
    int load_frames() {
        int frame = 0;
        for (; frame < plan_.frames; ++frame) {
            const nlohmann::json note = work_.load_note(frame_note(frame));
            if (note.is_null() || note.at("methods").size() != plan_.methods.size()) break;
            for (std::size_t m = 0; m < plan_.methods.size(); ++m) {
                flight_.methods[m].push_back(read_note(note["methods"][m]));
            }
            flight_.reference_error =
                std::max(flight_.reference_error, note.at("reference_error").get<double>());
            note.at("counters").get_to(earlier_counters_);
            second_looks_ = note.at("second_looks");
            list_frame(frame);
        }
        return frame;
    }

    void list_frame(int frame) {
        if (is_pictured(frame)) flight_.pictured.push_back(frame);
        if (is_measured(frame)) flight_.measured.push_back(frame);
    }

    void move_to(int frame) {
        time_s_ = path_.duration_s * frame / std::max(1, plan_.frames - 1);
        pose();
        const CameraKey key = evaluate_camera_path(path_, time_s_);
        const double aspect = double(renderers_.front()->width_px()) / renderers_.front()->height_px();
        camera_ =
            look_at(session_.loaded().world, key.position_ws, key.target_ws, key.vertical_fov_deg, aspect);
    }

    void pose() {
        session_.move_to(time_s_);
        for (Renderer* renderer : renderers_) renderer->update();
    }

    // Frame numbers leave room for the second look at a measured moment.
    FrameInput input_for(std::size_t method, int frame) const {
        FrameInput input;
        input.camera = camera_;
        input.frame = std::uint32_t(frame) + second_looks_;
        input.seed = options_.scene.seed;
        input.settings = plan_.methods[method].settings;
        return input;
    }

    FrameOutput render(std::size_t method, int frame) {
        return renderers_[method]->render(input_for(method, frame));
    }

    void fly_frame(int frame) {
        move_to(frame);
        std::vector<FlightFrame> records(renderers_.size());
        std::vector<Image> radiance(renderers_.size());
        bool sees_nothing = true;
        for (std::size_t method = 0; method < renderers_.size(); ++method) {
            const FrameOutput output = render(method, frame);
            records[method].timings = output.timings;
            records[method].rays = output.shadow_rays.traced;
            if (is_pictured(frame)) radiance[method] = renderers_[method]->read_radiance(output.radiance);
            if (is_measured(frame)) sees_nothing = sees_nothing && is_empty(output.gbuffer);
        }
        double reference_error = 0.0;
        if (is_measured(frame) && sees_nothing)
            warn_once(fmt::format("frame {}: nothing but sky is in view: its errors say nothing", frame));
        if (is_pictured(frame)) write_pictures(frame, radiance);
        if (is_measured(frame)) {
            const auto truth = find_truth(frame);
            flight_.interrupted = !truth;
            if (!truth) return;
            reference_error = truth->relative_error;
            measure(frame, *truth, radiance, records);
        }
        keep(frame, records, reference_error);
        flight_.interrupted = interrupt_flag();
    }

    void write_pictures(int frame, const std::vector<Image>& radiance) {
        if (!flight_.exposure_ev) {
            flight_.exposure_ev = measuring_exposure_ev(radiance.front());
            flight_.shown_ev = auto_exposure_ev(radiance.front(), options_.look.tone);
            work_.save_note("exposure", {*flight_.exposure_ev, *flight_.shown_ev});
        }
        for (std::size_t method = 0; method < radiance.size(); ++method) {
            write_picture(flight_picture_name(plan_, method, frame), radiance[method]);
        }
    }

    void write_picture(const std::string& name, const Image& radiance) const {
        write_png(out_ / name, display_from_radiance(radiance, *flight_.shown_ev, options_.look));
    }

    // Nothing where the user interrupts.
    std::optional<Truth> find_truth(int frame) {
        ReferenceSettings settings =
            truth_settings(renderers_.front()->width_px(), renderers_.front()->height_px(), camera_,
                           plan_.reference_spp, count_bounces(plan_.methods));
        settings.box_pixel_filter = any_antialiases(plan_.methods);
        const ReferenceResult reference = find_reference(session_, settings);
        if (reference.cancelled) return std::nullopt;
        write_picture(flight_reference_name(frame), reference.radiance);
        const auto left_out = find_silhouettes(session_.renderer(), session_.tracer(), input_for(0, frame));
        return make_truth(reference, left_out, flight_.exposure_ev);
    }

    void measure(int frame, const Truth& truth, const std::vector<Image>& radiance,
                 std::vector<FlightFrame>& records) {
        pose();  // nothing moves between the two looks
        ++second_looks_;
        const double truth_mean = mean_finite_value(truth.radiance);
        for (std::size_t method = 0; method < renderers_.size(); ++method) {
            records[method].errors = measure_picture(truth, radiance[method]);
            const Image again = renderers_[method]->read_radiance(render(method, frame).radiance);
            if (truth_mean > 0.0) {
                records[method].flicker = mean_absolute_difference(radiance[method], again) / truth_mean;
            }
        }
    }

    // Totals of earlier runs of this flight and of this one.
    void count_dropped() {
        flight_.counters.clear();
        for (std::size_t method = 0; method < renderers_.size(); ++method) {
            flight_.counters.push_back(renderers_[method]->read_counters());
            if (method >= earlier_counters_.size()) continue;
            for (const auto& [name, count] : earlier_counters_[method])
                flight_.counters[method][name] += count;
        }
    }

    void keep(int frame, std::vector<FlightFrame>& records, double reference_error) {
        count_dropped();
        nlohmann::json note = {{"methods", nlohmann::json::array()},
                               {"reference_error", reference_error},
                               {"second_looks", second_looks_},
                               {"counters", flight_.counters}};
        for (std::size_t method = 0; method < records.size(); ++method) {
            note["methods"].push_back(note_of(records[method]));
            flight_.methods[method].push_back(std::move(records[method]));
        }
        work_.save_note(frame_note(frame), note);
        flight_.reference_error = std::max(flight_.reference_error, reference_error);
        list_frame(frame);
    }

    const FlightPlan& plan_;
    const CameraPath& path_;
    const RenderOptions& options_;
    RenderSession& session_;
    std::vector<Renderer*> renderers_;
    std::filesystem::path out_;
    const WorkFolder& work_;
    Flight flight_;
    CameraRecord camera_{};
    double time_s_ = 0.0;
    std::uint32_t second_looks_ = 0;
    std::vector<std::map<std::string, std::uint64_t>> earlier_counters_;
};

}  // namespace

std::string flight_picture_name(const FlightPlan& plan, std::size_t method, int frame) {
    const std::string suffix = method == 0 ? "" : "_" + file_stem(plan.methods[method].label);
    return fmt::format("frame_{:04}{}.png", frame, suffix);
}

std::string flight_reference_name(int frame) {
    return fmt::format("reference_{:04}.png", frame);
}

Flight fly(const FlightPlan& plan, const CameraPath& path, const RenderOptions& options,
           RenderSession& session, std::vector<Renderer*> renderers, const std::filesystem::path& out,
           const WorkFolder& work) {
    return Flyer(plan, path, options, session, std::move(renderers), out, work).fly();
}

}  // namespace tarn
