#include "bench/bench_run.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "core/log.h"
#include "core/statistics.h"

namespace tarn {
namespace {

constexpr int TIMED_FRAMES = 3;
// A frame with a past costs the same whether the past is full or not.
constexpr int TIMING_WARM_UP_FRAMES = 2;
constexpr int CALIBRATION_ROUNDS = 3;
constexpr double GOOD_FIT = 0.15;
// Frame numbers of different cells never meet: the same seed gives each its own random numbers.
constexpr std::uint32_t FRAMES_PER_CELL = 1u << 20;
constexpr std::uint32_t CALIBRATION_FRAME = 1u << 30;

double time_frame_ms(FrameSource& source, std::size_t method, int warm_up_frames,
                     const RenderSettings& settings, double resolution) {
    std::vector<double> ms;
    for (int i = 0; i < warm_up_frames + TIMED_FRAMES; ++i) {
        const RenderedFrame frame =
            source.render({method, settings, 0, CALIBRATION_FRAME + std::uint32_t(i), i == 0, 0, resolution});
        if (i >= warm_up_frames) ms.push_back(frame.timings.frame_ms);
    }
    return quantile(ms, 0.5);
}

nlohmann::json note_of(const Cell& cell) {
    nlohmann::json settings;
    for (const Setting& setting : setting_table()) settings[setting.name] = setting.get(cell.fit.settings);
    return {{"resolution", cell.fit.resolution},
            {"frames", cell.fit.frames},
            {"expected_ms", cell.fit.expected_ms},
            {"settings", settings}};
}

TimeFit read_fit(const nlohmann::json& note) {
    TimeFit fit;
    fit.resolution = note.at("resolution");
    fit.frames = note.at("frames");
    fit.expected_ms = note.at("expected_ms");
    for (const Setting& setting : setting_table())
        setting.set(fit.settings, note.at("settings").at(setting.name));
    return fit;
}

std::string cell_name(const Cell& cell) {
    return cell.budget < 0 ? fmt::format("method{}_curve", cell.method)
                           : fmt::format("method{}_budget{}", cell.method, cell.budget);
}

// Milliseconds of a whole picture of a cell.
double try_fit(FrameSource& source, const Method& method, std::size_t index, const TimeFit& fit) {
    double ms = 0.0;
    const int warm_up_frames = std::min(method.warm_up_frames, TIMING_WARM_UP_FRAMES);
    for (int i = 0; i < warm_up_frames + fit.frames; ++i) {
        const RenderedFrame frame = source.render(
            {index, fit.settings, 0, CALIBRATION_FRAME + std::uint32_t(i), i == 0, 0, fit.resolution});
        if (i >= warm_up_frames) ms += frame.timings.frame_ms;
    }
    return ms;
}

// What a single picture can spend: a camera that moves has no second frame to average with.
TimeFit keep_one_frame(const TimeFit& fit) {
    return {fit.settings, fit.resolution, 1, fit.expected_ms / fit.frames};
}

Cell plan_cell(const BenchPlan& plan, std::size_t method_index, int budget, FrameSource& source) {
    const Method& method = plan.methods[method_index];
    if (budget < 0) {
        return {method_index, budget, {method.settings, 1.0, plan.moving ? 1 : plan.frames, 0.0}};
    }
    const auto timer = [&](const RenderSettings& settings, double resolution) {
        return time_frame_ms(source, method_index, std::min(method.warm_up_frames, TIMING_WARM_UP_FRAMES),
                             settings, resolution);
    };
    const double budget_ms = plan.budgets_ms[std::size_t(budget)];
    Cell cell{method_index, budget, {}};
    // A machine that was busy while it calibrated gives itself away when the fit is tried.
    for (int round = 0; round < CALIBRATION_ROUNDS; ++round) {
        cell.fit = fit_budget(method, budget_ms, timer);
        if (plan.moving) cell.fit = keep_one_frame(cell.fit);
        const double ms = try_fit(source, method, method_index, cell.fit);
        if (std::abs(ms - cell.fit.expected_ms) < GOOD_FIT * ms) break;
    }
    return cell;
}

SequenceRequest request_for(const BenchPlan& plan, const Cell& cell, std::uint32_t seed) {
    SequenceRequest request;
    request.method = cell.method;
    request.settings = cell.fit.settings;
    request.resolution = cell.fit.resolution;
    request.seed = seed;
    request.first_frame = FRAMES_PER_CELL * std::uint32_t(cell.budget + 1);
    request.warm_up_frames = plan.methods[cell.method].warm_up_frames;
    request.frames = cell.fit.frames;
    request.with_curve = cell.budget < 0;
    return request;
}

}  // namespace

std::string unit_name(const Cell& cell, std::uint32_t seed) {
    return fmt::format("{}_seed{}", cell_name(cell), seed);
}

std::vector<Cell> plan_cells(const BenchPlan& plan, FrameSource& source, const WorkFolder& work) {
    std::vector<Cell> cells;
    for (std::size_t method = 0; method < plan.methods.size(); ++method) {
        time_frame_ms(source, method, 0, plan.methods[method].settings, 1.0);  // compiles the shaders
        for (int budget = -1; budget < int(plan.budgets_ms.size()); ++budget) {
            Cell cell{method, budget, {}};
            const nlohmann::json note = work.load_note(cell_name(cell));
            if (note.is_null()) {
                cell = plan_cell(plan, method, budget, source);
                work.save_note(cell_name(cell), note_of(cell));
            } else {
                cell.fit = read_fit(note);
            }
            cells.push_back(cell);
        }
    }
    return cells;
}

void measure_cell(const BenchPlan& plan, const Cell& cell, int k, FrameSource& source, const Truth& truth,
                  const WorkFolder& work, const std::atomic<bool>& cancel) {
    if (cancel) throw Error("interrupted; the same command goes on where it stopped");
    const std::uint32_t seed = plan.first_seed + std::uint32_t(k);
    const std::string name = unit_name(cell, seed);
    if (!work.load_measure(name))
        work.save(name, measure_sequence(source, truth, request_for(plan, cell, seed)));
}

void measure_cells(const BenchPlan& plan, const std::vector<Cell>& cells, FrameSource& source,
                   const Truth& truth, const WorkFolder& work, const std::atomic<bool>& cancel) {
    Progress progress("measuring", std::uint64_t(plan.seeds) * cells.size());
    std::uint64_t done = 0;
    for (int k = 0; k < plan.seeds; ++k) {
        for (const Cell& cell : cells) {
            measure_cell(plan, cell, k, source, truth, work, cancel);
            progress.update(++done);
        }
    }
}

}  // namespace tarn
