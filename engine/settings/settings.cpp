// Values of settings as users write them.
#include "settings/settings.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include <fmt/ranges.h>

#include "core/error.h"

namespace tarn {
void Setting::parse(RenderSettings& settings, const std::string& text) const {
    if (!choices.empty()) {
        const auto choice = std::find(choices.begin(), choices.end(), text);
        if (choice == choices.end())
            throw Error("--{}: '{}' is none of: {}", name, text, fmt::join(choices, ", "));
        set(settings, double(choice - choices.begin()));
        return;
    }
    double value = 0.0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size() || !(value >= minimum && value <= maximum) ||
        (is_whole && value != std::floor(value))) {
        throw Error("--{}: '{}' is not a {}number from {} to {}", name, text, is_whole ? "whole " : "",
                    minimum, maximum);
    }
    set(settings, value);
}

std::string Setting::format(const RenderSettings& settings) const {
    const double value = get(settings);
    return choices.empty() ? fmt::format("{}", value) : choices[std::size_t(value)];
}

}  // namespace tarn
