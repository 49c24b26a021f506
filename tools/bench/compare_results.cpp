#include "bench/compare_results.h"

#include <cmath>
#include <map>
#include <vector>

#include "bench/compare_times.h"
#include "bench/finding.h"
#include "core/error.h"
#include "core/statistics.h"
#include "metrics/seed_statistics.h"

namespace tarn {
namespace {

using Json = nlohmann::ordered_json;

constexpr double SIGNIFICANCE = 0.01;

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

// A budget that gave other frames or another dial reflects the machine's speed that day, not the method.
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

// Counts have no noise: any increase is reported.
void compare_counts(const CellPair& pair, std::vector<Finding>& findings) {
    for (const auto& [name, count] : pair.after->at("counts").items()) {
        const double before = pair.before->at("counts").value(name, 0.0), after = count.get<double>();
        if (name == "rays_per_pixel" || before == after) continue;
        findings.push_back({pair.name + ": " + name, before, after, 0.0, false, after > before});
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
        drift.factor, 100.0 * drift.pass_scatter);
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
    const MachineDrift drift = compare_times(pairs, findings);

    const double threshold =
        findings.empty() ? 0.0 : sidak_threshold(SIGNIFICANCE, std::int64_t(findings.size()));
    Json told = Json::array();
    for (const Finding& finding : findings) {
        if (is_told(finding, threshold)) told.push_back(describe(finding));
    }
    Json json = {
        {"old", old_name}, {"machine_factor", drift.factor}, {"machine_scatter", drift.pass_scatter}};
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
