#include "bench/compare_results.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <vector>

#include "core/error.h"
#include "core/statistics.h"
#include "metrics/seed_statistics.h"

namespace tarn {
namespace {

using Json = nlohmann::ordered_json;

constexpr double SIGNIFICANCE = 0.01;

// What is compared of one cell, before and after.
struct CellPair {
    std::string name;  // "lantern_court, ris, 50 ms"
    const Json* before;
    const Json* after;
};

struct Finding {
    std::string what;
    double before = 0.0;
    double after = 0.0;
    double p_value = 1.0;
    bool is_time = false;
    bool is_worse = false;
};

std::string cell_name(const Json& cell) {
    if (!cell.at("budget_ms").is_null()) return fmt::format("{:g} ms", cell["budget_ms"].get<double>());
    return cell.at("kind") == "first" ? "one frame" : fmt::format("mean of {}", cell.at("frames").get<int>());
}

std::string scene_name(const Json& scene) {
    const std::string camera = scene.at("camera");
    return scene.at("name").get<std::string>() + (camera.empty() ? "" : " " + camera) +
           fmt::format(" {}x{}", scene.at("width").get<int>(), scene.at("height").get<int>());
}

std::map<std::string, const Json*> list_cells(const Json& results) {
    std::map<std::string, const Json*> cells;
    if (!results.contains("scenes")) return cells;
    for (const Json& scene : results.at("scenes")) {
        for (const Json& method : scene.at("methods")) {
            for (const Json& cell : method.at("cells")) {
                cells[fmt::format("{}, {}, {}", scene_name(scene), method.at("label").get<std::string>(),
                                  cell_name(cell))] = &cell;
            }
        }
    }
    return cells;
}

std::vector<CellPair> pair_cells(const Json& before, const Json& after, std::size_t& unpaired) {
    const auto old_cells = list_cells(before), new_cells = list_cells(after);
    std::vector<CellPair> pairs;
    for (const auto& [name, cell] : new_cells) {
        const auto old = old_cells.find(name);
        if (old != old_cells.end()) pairs.push_back({name, old->second, cell});
    }
    unpaired = old_cells.size() + new_cells.size() - 2 * pairs.size();
    return pairs;
}

std::vector<double> per_seed(const Json& estimate) {
    return estimate.at("per_seed").get<std::vector<double>>();
}

double mean_of(const std::vector<double>& values) {
    return estimate_mean(values).mean;
}

// ---- Errors ----

bool share_random_numbers(const Json& before, const Json& after, const CellPair& pair) {
    const auto seeds = [](const Json& results) {
        return results.value("settings", Json()).value("first_seed", 0u);
    };
    return seeds(before) == seeds(after) && pair.before->at("frames") == pair.after->at("frames") &&
           pair.before->at("settings") == pair.after->at("settings") &&
           pair.before->at("errors").at("mse").at("per_seed").size() ==
               pair.after->at("errors").at("mse").at("per_seed").size();
}

// A budget that bought other frames or another dial tells of the machine's speed that day, not of the method.
bool has_same_effort(const CellPair& pair) {
    return pair.after->at("budget_ms").is_null() ||
           (pair.before->at("frames") == pair.after->at("frames") &&
            pair.before->at("settings") == pair.after->at("settings"));
}

void compare_errors(const CellPair& pair, bool is_paired, std::vector<Finding>& findings) {
    for (const auto& [name, estimate] : pair.after->at("errors").items()) {
        if (!pair.before->at("errors").contains(name)) continue;
        const auto old_values = per_seed(pair.before->at("errors").at(name)), new_values = per_seed(estimate);
        const Difference change =
            is_paired ? test_paired(old_values, new_values) : test_independent(old_values, new_values);
        Finding finding{pair.name + ": " + name, mean_of(old_values), mean_of(new_values), change.p_value};
        // Energy is best at 1, all others at 0.
        const double best = name == "mean_ratio" ? 1.0 : 0.0;
        finding.is_worse = std::abs(finding.after - best) > std::abs(finding.before - best);
        findings.push_back(std::move(finding));
    }
}

// Counts come without noise: any more is told.
void compare_counts(const CellPair& pair, std::vector<Finding>& findings) {
    for (const auto& [name, count] : pair.after->at("counts").items()) {
        const double before = pair.before->at("counts").value(name, 0.0), after = count.get<double>();
        if (name == "rays_per_pixel" || before == after) continue;
        findings.push_back({pair.name + ": " + name, before, after, 0.0, false, after > before});
    }
}

// ---- Times ----

// Of a pass between two runs, roughly: below it a longer pass is worth no more than a shorter one.
constexpr double TYPICAL_SCATTER = 0.05;

// Logarithms of one time, one a seed, before and after.
struct TimeSeries {
    std::string name;
    std::vector<double> before;
    std::vector<double> after;

    double change() const { return quantile(after, 0.5) - quantile(before, 0.5); }
    // By which it varies whatever it does, as a logarithm.
    double jitter() const { return TIME_JITTER_MS / std::exp(quantile(before, 0.5)); }
    // What it is worth among others.
    double weight() const { return 1.0 / (jitter() * jitter() + TYPICAL_SCATTER * TYPICAL_SCATTER); }
};

struct Weighted {
    double value = 0.0;
    double weight = 1.0;
};

// Where half of the weight lies below.
double weighted_median(std::vector<Weighted> values) {
    std::sort(values.begin(), values.end(),
              [](const Weighted& a, const Weighted& b) { return a.value < b.value; });
    double total = 0.0, below = 0.0;
    for (const Weighted& v : values) total += v.weight;
    for (const Weighted& v : values) {
        below += v.weight;
        if (below >= 0.5 * total) return v.value;
    }
    return 0.0;
}

// All times of one cell. Its passes ran side by side, so a busy machine slowed them alike.
struct CellTimes {
    std::vector<TimeSeries> passes;
    TimeSeries frame;
    double factor = 0.0;  // logarithm of how much longer its passes took on the whole

    // Fewer cannot tell which of them changed.
    bool judges_passes() const { return passes.size() >= 3; }
};

std::vector<double> logarithms(const Json& times) {
    std::vector<double> logs = per_seed(times);
    for (double& value : logs) value = std::log(std::max(value, 1e-6));
    return logs;
}

CellTimes collect_times(const CellPair& pair) {
    CellTimes times;
    for (const Json& pass : pair.after->at("passes")) {
        for (const Json& old : pair.before->at("passes")) {
            if (old.at("name") != pass.at("name")) continue;
            times.passes.push_back({pair.name + ": pass " + pass.at("name").get<std::string>(),
                                    logarithms(old.at("ms")), logarithms(pass.at("ms"))});
        }
    }
    times.frame = {pair.name + ": frame", logarithms(pair.before->at("frame_ms")),
                   logarithms(pair.after->at("frame_ms"))};
    return times;
}

// Takes off each seed's share of slowness: the median over the passes of how far they lie above their own
// medians then.
void remove_slow_seeds(std::vector<TimeSeries>& series, std::vector<double> TimeSeries::*side) {
    std::size_t seeds = series.empty() ? 0 : (series.front().*side).size();
    for (const TimeSeries& s : series) seeds = std::min(seeds, (s.*side).size());
    std::vector<double> medians;
    for (const TimeSeries& s : series) medians.push_back(quantile(s.*side, 0.5));
    for (std::size_t seed = 0; seed < seeds; ++seed) {
        std::vector<Weighted> above;
        for (std::size_t i = 0; i < series.size(); ++i)
            above.push_back({(series[i].*side)[seed] - medians[i], series[i].weight()});
        const double slowness = weighted_median(std::move(above));
        for (TimeSeries& s : series) (s.*side)[seed] -= slowness;
    }
}

double median_change(const std::vector<TimeSeries>& series) {
    std::vector<Weighted> changes;
    for (const TimeSeries& s : series) changes.push_back({s.change(), s.weight()});
    return weighted_median(std::move(changes));
}

// Cells of equal settings alone: another number of candidates takes another time.
std::vector<CellTimes> collect_cells(const std::vector<CellPair>& pairs) {
    std::vector<CellTimes> cells;
    for (const CellPair& pair : pairs) {
        // First frame and mean of frames are the same sequence.
        if (pair.after->at("kind") == "first" || pair.before->at("settings") != pair.after->at("settings"))
            continue;
        CellTimes times = collect_times(pair);
        if (times.judges_passes()) {
            remove_slow_seeds(times.passes, &TimeSeries::before);
            remove_slow_seeds(times.passes, &TimeSeries::after);
            times.factor = median_change(times.passes);
        } else {
            times.factor = times.frame.change();
        }
        cells.push_back(std::move(times));
    }
    return cells;
}

// How numbers scatter around a centre that was found as their median.
struct Scatter {
    double deviation = 0.0;  // standard deviation, if they are normal but for a few
    double degrees_of_freedom = 0.0;
};

Scatter find_scatter(std::vector<Weighted> residuals, std::size_t centres) {
    constexpr double NORMAL_SD_PER_MAD = 1.4826;
    for (Weighted& residual : residuals) residual.value = std::abs(residual.value);
    const double count = double(residuals.size()), freedom = count - double(centres);
    if (freedom <= 0.0) return {};
    return {NORMAL_SD_PER_MAD * weighted_median(std::move(residuals)) * std::sqrt(count / freedom), freedom};
}

// How the two runs differ where nothing but the machine does.
struct MachineDrift {
    double factor = 0.0;  // logarithm: median over all cells
    Scatter cells;        // of cells around it
    Scatter passes;       // of passes around their cell
};

MachineDrift find_drift(const std::vector<CellTimes>& cells) {
    MachineDrift drift;
    std::vector<double> factors;
    std::vector<Weighted> cell_residuals, pass_residuals;
    for (const CellTimes& cell : cells) factors.push_back(cell.factor);
    drift.factor = quantile(factors, 0.5);
    std::size_t judging = 0;
    for (const CellTimes& cell : cells) {
        cell_residuals.push_back({cell.factor - drift.factor});
        if (!cell.judges_passes()) continue;
        ++judging;
        for (const TimeSeries& s : cell.passes)
            pass_residuals.push_back({s.change() - cell.factor, s.weight()});
    }
    drift.cells = find_scatter(std::move(cell_residuals), 1);
    drift.passes = find_scatter(std::move(pass_residuals), judging);
    return drift;
}

// How likely a time moves so far from `factor` by chance. Seeds tell how it varies within a run; between runs
// caches, clocks and neighbours are others, which no seed knows of: `scatter` tells that.
Finding judge_time(const TimeSeries& s, double factor, const Scatter& scatter) {
    RunningMoments before, after;
    for (const double value : s.before) before.add(value);
    for (const double value : s.after) after.add(value);
    Finding finding{s.name, std::exp(before.mean()), std::exp(after.mean() - factor), 1.0, true};
    finding.is_worse = finding.after > finding.before;
    const double variance = before.variance_of_mean() + after.variance_of_mean() +
                            scatter.deviation * scatter.deviation + s.jitter() * s.jitter();
    if (scatter.degrees_of_freedom > 0.0) {
        finding.p_value = student_t_two_sided_p_value(
            std::log(finding.after / finding.before) / std::sqrt(variance), scatter.degrees_of_freedom);
    }
    return finding;
}

void compare_times(const std::vector<CellTimes>& cells, const MachineDrift& drift,
                   std::vector<Finding>& findings) {
    for (const CellTimes& cell : cells) {
        findings.push_back(judge_time(cell.frame, drift.factor, drift.cells));
        if (!cell.judges_passes()) continue;
        for (const TimeSeries& s : cell.passes) findings.push_back(judge_time(s, cell.factor, drift.passes));
    }
}

// ---- Verdicts ----

bool is_told(const Finding& finding, double threshold) {
    const double change = std::abs(finding.after - finding.before);
    const double smallest = finding.is_time ? SMALLEST_TIME_CHANGE : SMALLEST_ERROR_CHANGE;
    return finding.p_value < threshold && change > smallest * std::abs(finding.before);
}

Json describe(const Finding& finding) {
    const char* verdict =
        finding.is_time ? (finding.is_worse ? "slower" : "faster") : (finding.is_worse ? "worse" : "better");
    Json json = {{"what", finding.what}, {"before", finding.before}, {"after", finding.after}};
    json["ratio"] = nullptr;
    if (finding.before != 0.0) json["ratio"] = finding.after / finding.before;
    json["verdict"] = verdict;
    json["p_value"] = finding.p_value;
    return json;
}

std::string summarize(std::size_t told, std::size_t tested, const MachineDrift& drift, std::size_t unpaired) {
    std::string text = told == 0
                           ? fmt::format("Nothing changed beyond the noise in {} comparisons.", tested)
                           : fmt::format("{} of {} comparisons changed beyond the noise.", told, tested);
    text += fmt::format(
        " The machine as a whole took {:.2f} times as long as before, which is taken off below; single "
        "passes "
        "scatter by {:.1f} % around that.",
        std::exp(drift.factor), 100.0 * drift.passes.deviation);
    if (unpaired > 0) text += fmt::format(" {} rows stand in one of the two runs alone.", unpaired);
    return text;
}

}  // namespace

Json compare_results(const Json& before, const Json& after, const std::string& old_name) {
    std::size_t unpaired = 0;
    const std::vector<CellPair> pairs = pair_cells(before, after, unpaired);
    std::vector<Finding> findings;
    for (const CellPair& pair : pairs) {
        if (!has_same_effort(pair)) continue;
        compare_errors(pair, share_random_numbers(before, after, pair), findings);
        compare_counts(pair, findings);
    }
    const std::vector<CellTimes> cells = collect_cells(pairs);
    const MachineDrift drift = find_drift(cells);
    compare_times(cells, drift, findings);

    const double threshold =
        findings.empty() ? 0.0 : sidak_threshold(SIGNIFICANCE, std::int64_t(findings.size()));
    Json told = Json::array();
    for (const Finding& finding : findings) {
        if (is_told(finding, threshold)) told.push_back(describe(finding));
    }
    Json json = {{"old", old_name},
                 {"machine_factor", std::exp(drift.factor)},
                 {"machine_scatter", drift.passes.deviation}};
    json["summary"] = summarize(told.size(), findings.size(), drift, unpaired);
    json["findings"] = std::move(told);
    return json;
}

void print_comparison(const Json& comparison) {
    fmt::print("\nAgainst {}: {}\n", comparison["old"].get<std::string>(),
               comparison["summary"].get<std::string>());
    for (const Json& finding : comparison["findings"]) {
        fmt::print("  {:<7} {}: {:.4g} -> {:.4g} (p = {:.1e})\n", finding["verdict"].get<std::string>(),
                   finding["what"].get<std::string>(), finding["before"].get<double>(),
                   finding["after"].get<double>(), finding["p_value"].get<double>());
    }
}

}  // namespace tarn
