// tarn study faults: does the benchmark find what it is made to find? Known faults are put into one of two
// methods of the real renderer, and the results are compared with those of a run without faults: each fault
// must show in its own column, and nothing may show in the other method's.
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <memory>

#include "bench/bench_run.h"
#include "bench/compare_results.h"
#include "bench/results.h"
#include "core/error.h"
#include "core/log.h"
#include "find_truth.h"
#include "interrupt.h"
#include "renderer_source.h"
#include "studies/study.h"

namespace tarn {
namespace {

using Json = nlohmann::ordered_json;

struct FaultStudy {
    RenderOptions options;
    int seeds = 12;
    int frames = 16;
    int reference_spp = 1024;
};

enum class Fault { NONE, BRIGHTER, SLOW_PASS, BIASED, DROPPED_FRAME };

constexpr double BRIGHTER_BY = 1.02;
constexpr double SLOWER_BY = 0.2;        // of the pass
constexpr double BIAS = 0.05;            // of the picture's mean, on every pixel
constexpr std::uint32_t LOST_FRAME = 5;  // of each sequence
constexpr const char* SLOW_PASS_NAME = "direct/candidates";
constexpr std::size_t FAULTY_METHOD = 1;  // of METHODS
constexpr const char* METHODS = "uniform,ris,power,light-tree";

// The renderer with a fault in one of its methods.
class FaultySource : public FrameSource {
  public:
    FaultySource(RendererSource& source, Fault fault, double mean_radiance)
        : source_(source), fault_(fault), mean_radiance_(mean_radiance) {}

    RenderedFrame render(const FrameRequest& request) override {
        RenderedFrame frame = source_.render(request);
        if (request.method != FAULTY_METHOD) return frame;
        if (request.starts) frames_ = 0;
        switch (fault_) {
            case Fault::NONE:
                break;
            case Fault::BRIGHTER:
                for (float& value : frame.radiance.values) value *= float(BRIGHTER_BY);
                break;
            case Fault::SLOW_PASS:
                slow_down(frame.timings);
                break;
            case Fault::BIASED:
                for (float& value : frame.radiance.values) value += float(BIAS * mean_radiance_);
                break;
            case Fault::DROPPED_FRAME:
                if (frames_ == LOST_FRAME) frame.radiance = before_;
                before_ = frame.radiance;
                break;
        }
        ++frames_;
        return frame;
    }

    std::map<std::string, std::uint64_t> read_counters(std::size_t method) override {
        return source_.read_counters(method);
    }

  private:
    // Works on for as long as the pass should have taken, by the clock, on all cores as a pass does: threads
    // that sleep meanwhile would find cold caches and make all passes after it slower.
    static void slow_down(FrameTimings& timings) {
        using Clock = std::chrono::steady_clock;
        for (PassTiming& pass : timings.passes) {
            if (pass.name != SLOW_PASS_NAME) continue;
            const auto start = Clock::now();
            const auto elapsed_ms = [&] {
                return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
            };
            tbb::parallel_for(0, tbb::this_task_arena::max_concurrency(), [&](int) {
                while (elapsed_ms() < SLOWER_BY * pass.ms) continue;
            });
            const double ms = elapsed_ms();
            pass.ms += ms;
            timings.frame_ms += ms;
        }
    }

    RendererSource& source_;
    Fault fault_;
    double mean_radiance_;
    std::uint32_t frames_ = 0;
    Image before_;
};

// A run of the benchmark, without budgets, on a source with a fault.
class FaultyRun {
  public:
    FaultyRun(const FaultStudy& study, const Truth& truth, RendererSource& source, Fault fault)
        : study_(study),
          truth_(truth),
          source_(source, fault, mean_finite_value(truth.radiance)),
          work_(folder_.path() / "unfinished", {{"study", "faults"}}) {
        plan_.methods = parse_methods(METHODS);
        plan_.seeds = study.seeds;
        plan_.first_seed = study.options.scene.seed;
        plan_.frames = study.frames;
        cells_ = plan_cells(plan_, source_, work_);
    }

    std::size_t cell_count() const { return cells_.size(); }
    void measure(std::size_t cell, int k) {
        measure_cell(plan_, cells_[cell], k, source_, truth_, work_, interrupt_flag());
    }

    // Results as tarn bench would write them.
    Json results() const {
        Json scene = {{"name", study_.options.scene.scene.stem().string()}, {"camera", ""}};
        scene["width"] = study_.options.scene.width;
        scene["height"] = study_.options.scene.height;
        scene["methods"] = describe_methods(plan_, cells_, truth_, work_, folder_.path(), "fault");
        Json results = {{"format", RESULTS_FORMAT}, {"version", RESULTS_VERSION}};
        results["settings"] = {{"first_seed", plan_.first_seed}};
        results["scenes"] = Json::array({std::move(scene)});
        return results;
    }

  private:
    const FaultStudy& study_;
    const Truth& truth_;
    TemporaryFolder folder_;
    FaultySource source_;
    BenchPlan plan_;
    WorkFolder work_;
    std::vector<Cell> cells_;
};

const Json& mean_cell(const Json& results) {
    return results["scenes"][0]["methods"][FAULTY_METHOD]["cells"][1];
}

// A fault, the column that must show it, and what that column says.
struct Expectation {
    const char* sentence;
    Fault fault;
    const char* finding;  // part of the comparison's line; empty: no line at all
    std::function<std::string(const Json& results, const Truth& truth)> column;  // empty text: it is not seen
};

// An interval that leaves out 0 effect and yet reaches what was planted. One of 95 % misses the truth in one
// of twenty runs: twice as wide, in one of ten thousand.
bool finds(double low, double high, double without, double planted) {
    return low > without && std::abs(planted - 0.5 * (low + high)) <= high - low;
}

std::string see_energy(const Json& results, const Truth&) {
    const Json& ratio = mean_cell(results)["errors"]["mean_ratio"];
    const double low = ratio["low"], high = ratio["high"];
    return finds(low, high, 1.0, BRIGHTER_BY)
               ? fmt::format("energy {:.4f} .. {:.4f}, planted {:.4f}", low, high, BRIGHTER_BY)
               : "";
}

std::string see_bias(const Json& results, const Truth& truth) {
    const Json& bias = mean_cell(results)["bias"];
    const double low = bias["low"], high = bias["high"];
    const double added = BIAS * mean_finite_value(truth.radiance) * std::exp2(double(truth.exposure_ev));
    return finds(low, high, 0.0, added * added)
               ? fmt::format("bias^2 {:.3g} .. {:.3g}, planted {:.3g}", low, high, added * added)
               : "";
}

std::string see_repeated_frames(const Json& results, const Truth&) {
    const int count = mean_cell(results)["counts"]["repeated_frames"];
    return count > 0 ? fmt::format("{} repeated frames", count) : "";
}

std::string see_comparison_alone(const Json&, const Truth&) {
    return "-";
}

const Expectation EXPECTATIONS[] = {
    {"nothing", Fault::NONE, "", see_comparison_alone},
    {"2 % brighter", Fault::BRIGHTER, ": mean_ratio", see_energy},
    {"a pass 20 % slower", Fault::SLOW_PASS, ": pass direct/candidates", see_comparison_alone},
    {"5 % of the mean added", Fault::BIASED, ": mse", see_bias},
    {"a dropped frame", Fault::DROPPED_FRAME, ": repeated_frames", see_repeated_frames},
};

// Whether the comparison tells of what it must, and of nothing in the other method.
bool tells(const Json& comparison, const Expectation& expectation, std::string& text) {
    bool told = false, innocent = true;
    for (const Json& finding : comparison["findings"]) {
        const std::string what = finding["what"];
        innocent = innocent && what.find(", ris,") != std::string::npos;
        if (*expectation.finding == '\0' || what.find(expectation.finding) == std::string::npos || told)
            continue;
        told = true;
        text = fmt::format("{} {:.4g} -> {:.4g}", what.substr(what.rfind(": ") + 2),
                           finding["before"].get<double>(), finding["after"].get<double>());
    }
    if (*expectation.finding == '\0') return comparison["findings"].empty();
    return told && innocent;
}

// The results of a run without a fault, and of one for each expectation. The runs go on side by side,
// sequence by sequence: on a machine that others use too, one minute differs from the next by more than a
// fault.
std::vector<Json> measure_all(const FaultStudy& study, const Truth& truth, RendererSource& source) {
    std::vector<std::unique_ptr<FaultyRun>> runs;
    runs.push_back(std::make_unique<FaultyRun>(study, truth, source, Fault::NONE));
    for (const Expectation& expectation : EXPECTATIONS)
        runs.push_back(std::make_unique<FaultyRun>(study, truth, source, expectation.fault));
    const std::size_t cells = runs.front()->cell_count();
    Progress progress("measuring", std::uint64_t(study.seeds) * cells * runs.size());
    std::uint64_t done = 0;
    for (int k = 0; k < study.seeds; ++k) {
        for (std::size_t cell = 0; cell < cells; ++cell) {
            for (const auto& run : runs) {
                run->measure(cell, k);
                progress.update(++done);
            }
        }
    }
    std::vector<Json> results;
    for (const auto& run : runs) results.push_back(run->results());
    return results;
}

void run(const FaultStudy& study) {
    check_output_folder(study.options.json_file);
    RenderSession session(study.options);
    const CameraRecord camera =
        choose_camera(study.options.scene, session.loaded().scene, session.loaded().world);
    const Truth truth = find_truth(session, study.options,
                                   truth_settings(study.options.scene.width, study.options.scene.height,
                                                  camera, study.reference_spp, 1));
    RendererSource source(session.loaded().world, session.tracer(), study.options.scene.width,
                          study.options.scene.height);
    source.set_camera(camera);
    const std::vector<Json> results = measure_all(study, truth, source);
    const Json& before = results.front();
    fmt::print("{:<24} {:<6} {:<46} {}\n", "put into ris", "seen", "column",
               "comparison with a run without faults");
    int missed = 0;
    Json report = {{"study", "faults"}, {"machine", session.describe_machine()}, {"before", before}};
    for (std::size_t i = 0; i < std::size(EXPECTATIONS); ++i) {
        const Expectation& expectation = EXPECTATIONS[i];
        const Json& after = results[i + 1];
        const Json comparison = compare_results(before, after, "a run without faults");
        std::string line = comparison["findings"].empty() ? "nothing changed beyond the noise" : "";
        const std::string column = expectation.column(after, truth);
        const bool seen = tells(comparison, expectation, line) && !column.empty();
        missed += !seen;
        fmt::print("{:<24} {:<6} {:<46} {}\n", expectation.sentence, seen ? "yes" : "NO", column, line);
        if (!seen) print_comparison(comparison);
        report["faults"].push_back(
            {{"fault", expectation.sentence}, {"seen", seen}, {"comparison", comparison}, {"after", after}});
    }
    if (!study.options.json_file.empty()) write_json(study.options.json_file, report);
    if (missed > 0)
        throw Error("study faults: {} of {} not as they should be", missed, std::size(EXPECTATIONS));
}

}  // namespace

void add_fault_study(CLI::App& app) {
    auto study = std::make_shared<FaultStudy>();
    CLI::App* sub =
        app.add_subcommand("faults", "Whether the benchmark finds faults that are put into a method");
    study->options.scene.scene = "cornell";
    study->options.scene.width = 320;
    study->options.scene.height = 180;
    add_session_options(*sub, study->options);
    sub->get_option("SCENE")->required(false);
    sub->add_option("--seeds", study->seeds, "Independent seeds")
        ->check(CLI::Range(3, 1000))
        ->capture_default_str();
    sub->add_option("--frames", study->frames, "Frames of each sequence, a power of two")
        ->check(CLI::IsMember({8, 16, 32, 64}))
        ->capture_default_str();
    sub->add_option("--reference-spp", study->reference_spp, "Samples a pixel of the reference")
        ->check(CLI::Range(2, 1000000))
        ->capture_default_str();
    sub->callback([study] { run(*study); });
}

}  // namespace tarn
