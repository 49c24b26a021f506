#include "bench/method.h"

#include <algorithm>
#include <ranges>
#include <set>

#include "bench/text.h"
#include "core/error.h"
#include "core/near_names.h"

namespace tarn {
namespace {

// One line is all that a new method needs: name, what it is, its settings as on the command line, its dial,
// its warm-up.
struct MethodRow {
    const char* name;
    const char* sentence;
    const char* settings;
    const char* dial;
    int warm_up_frames;
};

// Histories are full after as many frames as their confidence is capped at.
constexpr int RESTIR_WARM_UP_FRAMES = 20;
constexpr int CLEAN_WARM_UP_FRAMES = 24;

constexpr MethodRow METHODS[] = {
    {"uniform", "one light at random, one shadow ray", "direct=uniform", "samples", 0},
    {"power", "one light by its power, one shadow ray", "direct=power", "samples", 0},
    {"light-tree", "one light by a walk down the light tree, one shadow ray", "direct=light-tree", "samples",
     0},
    {"ris", "one light resampled from many candidates, one shadow ray", "direct=ris", "candidates", 0},
    {"restir-fast", "ReSTIR, preset fast: some bias, least noise for its time", "preset=fast", "candidates",
     RESTIR_WARM_UP_FRAMES},
    {"restir-balanced", "ReSTIR, preset balanced: the chosen sample traced", "preset=balanced", "candidates",
     RESTIR_WARM_UP_FRAMES},
    {"restir-fine", "ReSTIR, preset fine: lights by the light tree, a sample for each colour", "preset=fine",
     "candidates", RESTIR_WARM_UP_FRAMES},
    {"restir-unbiased", "ReSTIR, preset unbiased: rays in all MIS weights", "preset=unbiased", "candidates",
     RESTIR_WARM_UP_FRAMES},
    {"path", "preset fast, and indirect light by one path a pixel", "preset=fast,indirect=path", "",
     RESTIR_WARM_UP_FRAMES},
    {"restir-gi", "preset fast, and indirect light by path samples reused over time and neighbours",
     "preset=fast,indirect=restir", "", RESTIR_WARM_UP_FRAMES},
    {"clean", "what people see: all light, denoised and antialiased, preset clean", "preset=clean", "",
     CLEAN_WARM_UP_FRAMES},
    {"clean-noisy", "the samples of clean as they come: neither denoised nor antialiased",
     "preset=clean,denoise=off,antialias=off", "", 0},
};

// Applies "setting=value" or "preset=name" and returns what stands before the sign.
std::string apply_setting(RenderSettings& settings, const std::string& text, const std::string& method) {
    const std::size_t equals = text.find('=');
    if (equals == std::string::npos) {
        throw Error("method '{}': '{}' is not setting=value", method, text);
    }
    const std::string name = text.substr(0, equals);
    if (name == "preset") {
        settings = find_preset(text.substr(equals + 1)).settings;
        return name;
    }
    find_setting(name).parse(settings, text.substr(equals + 1));
    return name;
}

Method make_method(const MethodRow& row) {
    Method method{row.name, row.sentence, {}, row.dial, row.warm_up_frames};
    for (const std::string& setting : split(row.settings, ',')) {
        apply_setting(method.settings, setting, row.name);
        if (const std::string prefix = "preset="; setting.starts_with(prefix)) {
            method.sentence += "; " + find_preset(setting.substr(prefix.size())).describe_bias();
        }
    }
    return method;
}

}  // namespace

const std::vector<Method>& method_table() {
    static const std::vector<Method> table = [] {
        std::vector<Method> methods;
        for (const MethodRow& row : METHODS) methods.push_back(make_method(row));
        return methods;
    }();
    return table;
}

const Setting& find_setting(const std::string& name) {
    const auto& table = setting_table();
    const auto setting =
        std::find_if(table.begin(), table.end(), [&](const Setting& s) { return s.name == name; });
    if (setting != table.end()) return *setting;
    throw Error("'{}' is no setting; there are: {}", name,
                fmt::join(table | std::views::transform(&Setting::name), ", "));
}

int count_bounces(const std::vector<Method>& methods) {
    const auto bounces_of = [](const Method& method) {
        const IndirectSettings& indirect = method.settings.indirect;
        return 1 + (indirect.runs() ? indirect.bounces : 0);
    };
    for (const Method& method : methods) {
        if (bounces_of(method) == bounces_of(methods.front())) continue;
        throw Error(
            "methods '{}' and '{}' need references of {} and {} bounces: compare them in runs of their own",
            methods.front().label, method.label, bounces_of(methods.front()), bounces_of(method));
    }
    return bounces_of(methods.front());
}

bool any_antialiases(const std::vector<Method>& methods) {
    return std::any_of(methods.begin(), methods.end(),
                       [](const Method& method) { return method.settings.antialias.moves_samples(); });
}

namespace {

std::vector<std::string> list_names(const std::vector<Method>& table) {
    std::vector<std::string> names;
    for (const Method& method : table) names.push_back(method.label);
    return names;
}

Method read_method(const std::string& text) {
    const std::size_t colon = text.find(':');
    const std::string name = text.substr(0, colon);
    const auto& table = method_table();
    const auto row =
        std::find_if(table.begin(), table.end(), [&](const Method& m) { return m.label == name; });
    if (row == table.end()) {
        const std::vector<std::string> names = list_names(table);
        throw Error("'{}' is no method; there are: {}{}", name, fmt::join(names, ", "),
                    suggest_names(name, names));
    }
    Method method = *row;
    method.label = text;
    if (colon == std::string::npos) return method;
    std::set<std::string> given;
    for (const std::string& setting : split(text.substr(colon + 1), ',')) {
        given.insert(apply_setting(method.settings, setting, text));
    }
    if (given.contains(method.dial)) method.dial = !method.settings.direct.reuses() ? "samples" : "";
    if (given.contains(method.dial)) method.dial.clear();
    return method;
}

}  // namespace

Method parse_method(const std::string& text) {
    try {
        return read_method(text);
    } catch (const Error& error) {
        throw UsageError("{}", error.what());
    }
}

std::vector<Method> parse_methods(const std::string& text) {
    std::vector<std::string> pieces;
    for (const std::string& piece : split(text, ',')) {
        const bool continues = piece.find('=') != std::string::npos && piece.find(':') == std::string::npos;
        if (continues && !pieces.empty()) {
            pieces.back() += "," + piece;
        } else {
            pieces.push_back(piece);
        }
    }
    std::vector<Method> methods;
    for (const std::string& piece : pieces) {
        const auto same = [&](const Method& m) { return m.label == piece; };
        if (std::any_of(methods.begin(), methods.end(), same))
            throw UsageError("method '{}' is named twice", piece);
        methods.push_back(parse_method(piece));
    }
    return methods;
}

}  // namespace tarn
