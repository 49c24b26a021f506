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

// Logarithms of one pass's time, one a seed, before and after.
struct TimeSeries {
    std::string name;
    std::vector<double> before;
    std::vector<double> after;
};

std::vector<double> logarithms(const Json& times) {
    std::vector<double> logs = per_seed(times);
    for (double& value : logs) value = std::log(std::max(value, 1e-6));
    return logs;
}

// Cells of equal settings alone: another number of candidates takes another time.
std::vector<TimeSeries> collect_times(const std::vector<CellPair>& pairs) {
    std::vector<TimeSeries> series;
    for (const CellPair& pair : pairs) {
        // First frame and mean of frames are the same sequence.
        if (pair.after->at("kind") == "first" || pair.before->at("settings") != pair.after->at("settings"))
            continue;
        for (const Json& pass : pair.after->at("passes")) {
            for (const Json& old : pair.before->at("passes")) {
                if (old.at("name") != pass.at("name")) continue;
                series.push_back({pair.name + ": pass " + pass.at("name").get<std::string>(),
                                  logarithms(old.at("ms")), logarithms(pass.at("ms"))});
            }
        }
        series.push_back({pair.name + ": frame", logarithms(pair.before->at("frame_ms")),
                          logarithms(pair.after->at("frame_ms"))});
    }
    return series;
}

// Takes off each seed's share of slowness: the median over all series of how far they lie above their own
// medians then.
void remove_slow_seeds(std::vector<TimeSeries>& series, std::vector<double> TimeSeries::*side) {
    std::size_t seeds = series.empty() ? 0 : (series.front().*side).size();
    for (const TimeSeries& s : series) seeds = std::min(seeds, (s.*side).size());
    std::vector<double> medians;
    for (const TimeSeries& s : series) medians.push_back(quantile(s.*side, 0.5));
    for (std::size_t seed = 0; seed < seeds; ++seed) {
        std::vector<double> above;
        for (std::size_t i = 0; i < series.size(); ++i) above.push_back((series[i].*side)[seed] - medians[i]);
        const double slowness = quantile(above, 0.5);
        for (TimeSeries& s : series) (s.*side)[seed] -= slowness;
    }
}

// Logarithm of the factor between the machines of the two runs: the median over all series.
double find_machine_factor(const std::vector<TimeSeries>& series) {
    std::vector<double> factors;
    for (const TimeSeries& s : series) factors.push_back(quantile(s.after, 0.5) - quantile(s.before, 0.5));
    return quantile(factors, 0.5);
}

void compare_times(std::vector<TimeSeries> series, double machine_factor, std::vector<Finding>& findings) {
    remove_slow_seeds(series, &TimeSeries::before);
    remove_slow_seeds(series, &TimeSeries::after);
    for (TimeSeries& s : series) {
        for (double& value : s.after) value -= machine_factor;
        const Difference change = test_independent(s.before, s.after);
        Finding finding{s.name, std::exp(mean_of(s.before)), std::exp(mean_of(s.after)), change.p_value,
                        true};
        finding.is_worse = change.value > 0.0;
        findings.push_back(std::move(finding));
    }
}

// ---- Verdicts ----

bool is_told(const Finding& finding, double threshold) {
    const double smallest = finding.is_time ? SMALLEST_TIME_CHANGE : SMALLEST_ERROR_CHANGE;
    const double change = std::abs(finding.after - finding.before);
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

std::string summarize(std::size_t told, std::size_t tested, double machine_factor, std::size_t unpaired) {
    std::string text = told == 0
                           ? fmt::format("Nothing changed beyond the noise in {} comparisons.", tested)
                           : fmt::format("{} of {} comparisons changed beyond the noise.", told, tested);
    text += fmt::format(
        " The machine as a whole took {:.2f} times as long as before; times below have that taken off.",
        std::exp(machine_factor));
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
    const std::vector<TimeSeries> series = collect_times(pairs);
    const double machine_factor = series.empty() ? 0.0 : find_machine_factor(series);
    compare_times(series, machine_factor, findings);

    const double threshold =
        findings.empty() ? 0.0 : sidak_threshold(SIGNIFICANCE, std::int64_t(findings.size()));
    Json told = Json::array();
    for (const Finding& finding : findings) {
        if (is_told(finding, threshold)) told.push_back(describe(finding));
    }
    Json json = {{"old", old_name}, {"machine_factor", std::exp(machine_factor)}};
    json["summary"] = summarize(told.size(), findings.size(), machine_factor, unpaired);
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
