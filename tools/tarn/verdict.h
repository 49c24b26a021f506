// Limits that a user sets for measured values: `--max flip_ldr=0.05`.
#pragma once

#include <CLI/CLI.hpp>

#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <vector>

namespace tarn {

// What was measured lies beyond a limit; what() says which, one line each. main turns it into exit status 3.
struct LimitPassed : std::runtime_error {
    using std::runtime_error::runtime_error;
};

struct Limit {
    std::string key;
    double value = 0.0;
    bool is_greatest = true;  // else the least
};

// Adds --max and --min, KEY=VALUE, each as often as one likes. `keys`: what there is. Wrong usage for another
// key, and for a value that is not a number.
void add_limit_options(CLI::App& command, const std::vector<std::string>& keys, std::vector<Limit>& limits);

// "at most 0.05"
std::string describe_limit(const Limit& limit);

// A limit that was passed, and the value that did so.
struct Breach {
    Limit limit;
    double value = 0.0;
};

// "flip is 0.06, at most 0.05 is allowed"
std::string describe_breach(const Breach& breach);

// Which of `limits` the values of `measured` pass, or are no number for; in the order of `limits`. Throws
// Error for a value that was not measured.
std::vector<Breach> find_breaches(const nlohmann::ordered_json& measured, const std::vector<Limit>& limits);

// Throws LimitPassed where find_breaches finds any.
void check_limits(const nlohmann::ordered_json& measured, const std::vector<Limit>& limits);

}  // namespace tarn
