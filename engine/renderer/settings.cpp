#include "renderer/settings.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "core/error.h"

namespace tarn {
namespace {

std::string join(const std::vector<std::string>& words) {
    std::string result;
    for (const std::string& word : words) result += (result.empty() ? "" : ", ") + word;
    return result;
}

}  // namespace

void Setting::parse(RenderSettings& settings, const std::string& text) const {
    if (!choices.empty()) {
        const auto choice = std::find(choices.begin(), choices.end(), text);
        if (choice == choices.end()) throw Error("--{}: '{}' is none of: {}", name, text, join(choices));
        set(settings, double(choice - choices.begin()));
        return;
    }
    double value = 0.0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size() || !(value >= minimum && value <= maximum) ||
        value != std::floor(value)) {
        throw Error("--{}: '{}' is not a whole number from {} to {}", name, text, minimum, maximum);
    }
    set(settings, value);
}

std::string Setting::format(const RenderSettings& settings) const {
    const double value = get(settings);
    return choices.empty() ? fmt::format("{}", value) : choices[std::size_t(value)];
}

const std::vector<Setting>& setting_table() {
    static const std::vector<Setting> table = {
        {"direct",
         "",
         "How direct light chooses its sample: one random light, or RIS over many candidates",
         0,
         1,
         {"uniform", "ris"},
         [](const RenderSettings& s) { return double(s.direct); },
         [](RenderSettings& s, double v) { s.direct = DirectMode(int(v)); }},
        {"candidates",
         "",
         "Light candidates a pixel that RIS chooses from",
         1,
         1024,
         {},
         [](const RenderSettings& s) { return double(s.candidates); },
         [](RenderSettings& s, double v) { s.candidates = int(v); }},
    };
    return table;
}

}  // namespace tarn
