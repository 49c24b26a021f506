#include "bench/equal_time.h"

#include <cmath>
#include <vector>

#include "metrics/seed_statistics.h"

namespace tarn {
namespace {

using Json = nlohmann::ordered_json;

// One method at one budget.
struct Entry {
    const Json* method;
    const Json* cell;

    double error() const { return cell->at("errors").at("rel_mse").at("mean"); }
    std::vector<double> errors() const { return cell->at("errors").at("rel_mse").at("per_seed"); }
};

double sum_without(const std::vector<double>& values, std::size_t left_out) {
    double sum = 0.0;
    for (std::size_t i = 0; i < values.size(); ++i) {
        if (i != left_out) sum += values[i];
    }
    return sum;
}

Json describe_ratio(const Entry& entry, const Entry& best) {
    const std::vector<double> errors = entry.errors(), best_errors = best.errors();
    const Estimate log_ratio = estimate_jackknife(errors.size(), [&](std::size_t left_out) {
        return std::log(sum_without(errors, left_out) / sum_without(best_errors, left_out));
    });
    return {{"label", entry.method->at("label")}, {"ms", entry.cell->at("ms").at("median")},
            {"rel_mse", entry.error()},           {"ratio", std::exp(log_ratio.mean)},
            {"low", std::exp(log_ratio.low)},     {"high", std::exp(log_ratio.high)}};
}

// What each method did with budget number `index`, counted from 0.
std::vector<Entry> collect_entries(const Json& methods, std::size_t index) {
    std::vector<Entry> entries;
    for (const Json& method : methods) {
        std::size_t found = 0;
        for (const Json& cell : method.at("cells")) {
            if (cell.at("budget_ms").is_null() || found++ != index) continue;
            entries.push_back({&method, &cell});
        }
    }
    return entries;
}

}  // namespace

Json describe_equal_time(const Json& methods) {
    Json budgets = Json::array();
    for (std::size_t index = 0;; ++index) {
        const std::vector<Entry> entries = collect_entries(methods, index);
        if (entries.empty()) return budgets;
        const Entry* best = &entries.front();
        for (const Entry& entry : entries) {
            if (entry.error() < best->error()) best = &entry;
        }
        Json ratios = Json::array();
        for (const Entry& entry : entries) ratios.push_back(describe_ratio(entry, *best));
        budgets.push_back({{"budget_ms", entries.front().cell->at("budget_ms")},
                           {"best", best->method->at("label")},
                           {"ratios", std::move(ratios)}});
    }
}

}  // namespace tarn
