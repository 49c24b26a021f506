// What the parts of a comparison of two results.json share: pairs of cells, and findings.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace tarn {

// What is compared of one cell, before and after.
struct CellPair {
    std::string name;  // "lantern_court, ris, 50 ms"
    const nlohmann::ordered_json* before;
    const nlohmann::ordered_json* after;
};

// One number before and after, whether it is worth telling or not.
struct Finding {
    std::string what;
    double before = 0.0;
    double after = 0.0;
    double p_value = 1.0;  // of so large a change by chance alone
    bool is_time = false;
    bool is_worse = false;
};

// The values of an estimate, one a seed.
inline std::vector<double> per_seed(const nlohmann::ordered_json& estimate) {
    return estimate.at("per_seed").get<std::vector<double>>();
}

}  // namespace tarn
