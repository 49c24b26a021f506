#include "verdict.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "core/error.h"

namespace tarn {
namespace {

Limit parse_limit(const std::string& option, const std::string& text, const std::vector<std::string>& keys,
                  bool is_greatest) {
    const std::size_t equals = text.find('=');
    const std::string key = text.substr(0, equals);
    if (std::find(keys.begin(), keys.end(), key) == keys.end()) {
        throw CLI::ValidationError(option, fmt::format("'{}' is none of: {}", key, fmt::join(keys, ", ")));
    }
    const std::string number = equals == std::string::npos ? "" : text.substr(equals + 1);
    Limit limit{key, 0.0, is_greatest};
    const auto [end, error] = std::from_chars(number.data(), number.data() + number.size(), limit.value);
    if (error != std::errc() || end != number.data() + number.size() || !std::isfinite(limit.value))
        throw CLI::ValidationError(option, fmt::format("'{}' is not KEY=NUMBER", text));
    return limit;
}

}  // namespace

void add_limit_options(CLI::App& command, const std::vector<std::string>& keys, std::vector<Limit>& limits) {
    const auto add = [&](const char* option, const char* what, bool is_greatest) {
        const auto parse = [&limits, keys, option, is_greatest](const std::vector<std::string>& texts) {
            for (const std::string& text : texts)
                limits.push_back(parse_limit(option, text, keys, is_greatest));
            return true;
        };
        command
            .add_option(
                option, parse,
                fmt::format("End with status 3 where KEY is {} VALUE; keys: {}", what, fmt::join(keys, ", ")))
            ->type_name("KEY=VALUE")
            ->expected(1)
            ->take_all();
    };
    add("--max", "above", true);
    add("--min", "below", false);
}

std::string describe_limit(const Limit& limit) {
    return fmt::format("{} {:g}", limit.is_greatest ? "at most" : "at least", limit.value);
}

std::string describe_breach(const Breach& breach) {
    return fmt::format("{} is {:g}, {} is allowed", breach.limit.key, breach.value,
                       describe_limit(breach.limit));
}

std::vector<Breach> find_breaches(const nlohmann::ordered_json& measured, const std::vector<Limit>& limits) {
    std::vector<Breach> breaches;
    for (const Limit& limit : limits) {
        const auto& value = measured.at(limit.key);
        if (value.is_null()) throw Error("{} is not measured for these pictures", limit.key);
        const double number = value.get<double>();
        const bool holds = limit.is_greatest ? number <= limit.value : number >= limit.value;
        if (!holds) breaches.push_back({limit, number});  // NaN never holds
    }
    return breaches;
}

void check_limits(const nlohmann::ordered_json& measured, const std::vector<Limit>& limits) {
    std::vector<std::string> lines;
    for (const Breach& breach : find_breaches(measured, limits)) lines.push_back(describe_breach(breach));
    if (!lines.empty()) throw LimitPassed(fmt::format("{}", fmt::join(lines, "\ntarn: ")));
}

}  // namespace tarn
