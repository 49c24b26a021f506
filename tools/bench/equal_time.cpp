#include "bench/equal_time.h"

#include <fmt/format.h>

#include <cmath>
#include <string>
#include <vector>

#include "metrics/seed_statistics.h"

namespace tarn {
namespace {

using Json = nlohmann::ordered_json;

constexpr double MOST_OFF_BUDGET = 0.25;  // as a share of it

// One method at one budget.
struct Entry {
    const Json* method;
    const Json* cell;

    double error() const { return cell->at("errors").at("rel_mse").at("mean"); }
    std::vector<double> errors() const { return cell->at("errors").at("rel_mse").at("per_seed"); }
    double ms() const { return cell->at("ms").at("median"); }

    // Why it cannot be compared; empty: it can.
    std::string find_reason() const {
        const double budget_ms = cell->at("budget_ms"), resolution = cell->at("resolution");
        if (resolution != 1.0) return fmt::format("drawn at {:.0f} % of the resolution", 100.0 * resolution);
        if (std::abs(ms() / budget_ms - 1.0) > MOST_OFF_BUDGET) return fmt::format("took {:.0f} ms", ms());
        return "";
    }
};

double sum_without(const std::vector<double>& values, std::size_t left_out) {
    double sum = 0.0;
    for (std::size_t i = 0; i < values.size(); ++i) {
        if (i != left_out) sum += values[i];
    }
    return sum;
}

// Of an entry that has a reason.
Json describe_left_out(const Entry& entry, const std::string& reason) {
    return {{"label", entry.method->at("label")},
            {"ms", entry.ms()},
            {"rel_mse", entry.error()},
            {"ratio", nullptr},
            {"low", nullptr},
            {"high", nullptr},
            {"reason", reason}};
}

Json describe_ratio(const Entry& entry, const Entry& best) {
    const std::vector<double> errors = entry.errors(), best_errors = best.errors();
    const Estimate log_ratio = estimate_jackknife(errors.size(), [&](std::size_t left_out) {
        return std::log(sum_without(errors, left_out) / sum_without(best_errors, left_out));
    });
    return {{"label", entry.method->at("label")},
            {"ms", entry.ms()},
            {"rel_mse", entry.error()},
            {"ratio", std::exp(log_ratio.mean)},
            {"low", std::exp(log_ratio.low)},
            {"high", std::exp(log_ratio.high)},
            {"reason", nullptr}};
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
        const Entry* best = nullptr;
        for (const Entry& entry : entries) {
            if (entry.find_reason().empty() && (best == nullptr || entry.error() < best->error()))
                best = &entry;
        }
        Json ratios = Json::array();
        for (const Entry& entry : entries) {
            const std::string reason = entry.find_reason();
            ratios.push_back(reason.empty() ? describe_ratio(entry, *best)
                                            : describe_left_out(entry, reason));
        }
        budgets.push_back({{"budget_ms", entries.front().cell->at("budget_ms")},
                           {"best", best != nullptr ? best->method->at("label") : Json()},
                           {"ratios", std::move(ratios)}});
    }
}

}  // namespace tarn
