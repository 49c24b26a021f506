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

namespace {

// A row for a choice: `member` is an enumeration whose values count `choices`, or a bool for off and on.
template <class T>
Setting choose(std::string name, std::string sentence, T DirectSettings::*member,
               std::vector<std::string> choices) {
    const double last = double(choices.size() - 1);
    return {std::move(name),
            "",
            std::move(sentence),
            0.0,
            last,
            std::move(choices),
            true,
            [member](const RenderSettings& s) { return double(s.*member); },
            [member](RenderSettings& s, double v) { s.*member = T(int(v)); }};
}

Setting toggle(std::string name, std::string sentence, bool DirectSettings::*member) {
    return choose(std::move(name), std::move(sentence), member, {"off", "on"});
}

// A row for a number of type T, whole where T is.
template <class T>
Setting number(std::string name, std::string unit, std::string sentence, T DirectSettings::*member,
               double minimum, double maximum) {
    return {std::move(name),
            std::move(unit),
            std::move(sentence),
            minimum,
            maximum,
            {},
            std::is_integral_v<T>,
            [member](const RenderSettings& s) { return double(s.*member); },
            [member](RenderSettings& s, double v) { s.*member = T(v); }};
}

// The same row, hidden where `applies` does not hold.
Setting where(bool (DirectSettings::*applies)() const, Setting setting) {
    setting.applies = [applies](const RenderSettings& s) { return (s.*applies)(); };
    return setting;
}

}  // namespace

const std::vector<Setting>& setting_table() {
    using S = DirectSettings;
    static const std::vector<Setting> table = {
        choose("direct",
               "How direct light chooses its sample: one random light, one by power, one by the light tree, "
               "RIS over "
               "many candidates, or RIS with samples reused over time and neighbours",
               &S::direct, {"uniform", "power", "light-tree", "ris", "restir"}),
        where(&S::resamples,
              choose("light-selection",
                     "How a candidate of ris and restir finds its light; tiles: by power, drawn in advance",
                     &S::light_selection, {"uniform", "power", "tiles", "tree"})),
        where(&S::resamples,
              number("candidates", "", "Light candidates a pixel that ris and restir choose from",
                     &S::candidates, 1, 1024)),
        where(
            &S::resamples,
            toggle(
                "brdf-candidate",
                "One candidate more from a ray along the BRDF, joined by MIS: for mirrors and glossy floors",
                &S::brdf_candidate)),
        where(&S::takes_samples,
              number("samples", "", "Samples a pixel and frame, each with a ray; reuse keeps one",
                     &S::samples, 1, 256)),
        where(&S::uses_restir, choose("reuse", "restir: which samples are reused", &S::reuse,
                                      {"none", "temporal", "spatial", "spatiotemporal"})),
        where(&S::reuses_space, number("spatial-iterations", "", "restir: steps of reuse over neighbours",
                                       &S::spatial_iterations, 1, 4)),
        where(&S::reuses_space, number("neighbours", "", "restir: neighbours a step", &S::neighbours, 1, 9)),
        where(&S::reuses_space,
              number("radius", "px", "restir: greatest distance of a neighbour", &S::radius_px, 1, 100)),
        where(&S::reuses_both,
              toggle("feedback",
                     "restir: the next frame reuses the result of spatial reuse, instead of that of temporal "
                     "reuse: "
                     "a sample has seen more candidates, but more pixels end up with the same one",
                     &S::feedback)),
        where(&S::reuses, choose("mis",
                                 "restir: weights of reused samples: 1/M, 1/Z, generalized balance "
                                 "heuristic, pairwise defensive",
                                 &S::mis, {"constant", "count", "balance", "pairwise"})),
        where(&S::reuses, toggle("mis-visibility",
                                 "restir: trace visibility in the weights, which makes count, balance and "
                                 "pairwise unbiased, also "
                                 "while things move",
                                 &S::mis_visibility)),
        where(
            &S::reuses,
            choose(
                "visibility",
                "restir: how the chosen sample's visibility is known: traced at the end, reused with it, or "
                "averaged "
                "over all samples of each step",
                &S::visibility, {"trace", "reuse", "averaged"})),
        where(
            &S::can_shade_all,
            choose("shade",
                   "restir: what lights a pixel: its chosen sample, or all of the last step by their weights",
                   &S::shade, {"chosen", "all"})),
        where(&S::reuses, toggle("discard-occluded",
                                 "restir: drop fresh samples that are occluded before they are reused",
                                 &S::discard_occluded)),
        toggle("per-channel",
               "A sample for each of red, green and blue: no colour noise or leak, three times the cost",
               &S::per_channel),
        where(&S::reuses_time,
              number("confidence-cap", "x",
                     "restir: confidence of the history at most, as a multiple of the fresh sample's",
                     &S::confidence_cap, 1, 1000)),
        where(&S::reuses_time, number("motion-cap", "x",
                                      "restir: the same cap in frames in which camera, lights or geometry "
                                      "moved: a long history adds noise there",
                                      &S::motion_cap, 1, 1000)),
        where(&S::reuses_time, number("age-cap", "frames", "restir: drop samples older than this; 0: never",
                                      &S::age_cap, 0, 1000)),
        where(&S::reuses_time,
              number("boiling-filter", "x",
                     "restir: drop samples that outweigh the mean of their 8 x 8 pixels this many times; "
                     "darkens; 0: none",
                     &S::boiling_filter, 0, 1000)),
        where(&S::reuses_time,
              toggle("permute", "restir: neighbours swap their histories, so that fewer share a sample",
                     &S::permute)),
        where(&S::reuses_space,
              toggle("mirror",
                     "restir: neighbours outside of the picture are mirrored into it instead of left out",
                     &S::mirror)),
        choose("debug-view",
               "Show the visibility of the chosen samples, their light without it, or which they are, in "
               "colours",
               &S::debug_view, {"none", "visibility", "unshadowed", "samples"}),
    };
    return table;
}

namespace {

// Near neighbours mostly see the same lights, so reuse adds little bias. Without feedback less of it returns
// in the next frame.
constexpr double PRESET_RADIUS_PX = 16.0;

RenderSettings fast_settings() {
    RenderSettings s;
    s.direct = DirectMode::RESTIR;
    s.light_selection = LightSelection::TILES;
    s.candidates = 8;
    s.neighbours = 1;
    s.radius_px = PRESET_RADIUS_PX;
    s.feedback = false;
    s.mis = Mis::BALANCE;
    s.visibility = SampleVisibility::AVERAGED;
    s.shade = SampleShading::ALL;
    s.age_cap = 30;
    return s;
}

RenderSettings balanced_settings() {
    RenderSettings s;
    s.direct = DirectMode::RESTIR;
    s.light_selection = LightSelection::TILES;
    s.candidates = 16;
    s.brdf_candidate = true;
    s.neighbours = 3;
    s.radius_px = PRESET_RADIUS_PX;
    s.feedback = false;
    s.mis = Mis::PAIRWISE;
    s.age_cap = 30;
    return s;
}

RenderSettings fine_settings() {
    RenderSettings s = balanced_settings();
    s.light_selection = LightSelection::TREE;
    s.candidates = 4;
    s.per_channel = true;
    return s;
}

RenderSettings unbiased_settings() {
    RenderSettings s = balanced_settings();
    s.mis_visibility = true;
    s.shade = SampleShading::ALL;
    s.age_cap = 0;
    return s;
}

RenderSettings student_settings() {
    RenderSettings s;
    s.direct = DirectMode::RESTIR;
    s.light_selection = LightSelection::UNIFORM;
    s.candidates = 32;
    s.neighbours = 5;
    s.radius_px = 10.0;
    s.motion_cap = s.confidence_cap;
    s.mis = Mis::SHARE;
    return s;
}

}  // namespace

const std::vector<Preset>& preset_table() {
    static const std::vector<Preset> table = {
        {"fast", "two shadow rays a pixel, visibility averaged: some bias, least noise for its time",
         fast_settings(), 0.05},
        {"balanced",
         "two shadow rays and one along the BRDF a pixel, the chosen sample traced: darkens near shadow "
         "edges",
         balanced_settings(), 0.08},
        {"fine",
         "balanced, with lights drawn by the light tree and a sample for each colour: no colour noise, twice "
         "the time",
         fine_settings(), 0.08},
        {"unbiased", "rays in all MIS weights; those of the last frame meet the last frame's geometry",
         unbiased_settings(), 0.0},
        {"student", "32 random lights, 5 neighbours in 10 px, 1/M weights: the simplest form, for comparison",
         student_settings(), 0.2},
    };
    return table;
}

std::string Preset::describe_bias() const {
    return energy_bound == 0.0 ? "no bias" : fmt::format("energy within {:.0f} %", 100.0 * energy_bound);
}

const Preset& find_preset(const std::string& name) {
    std::vector<std::string> names;
    for (const Preset& preset : preset_table()) {
        if (preset.name == name) return preset;
        names.push_back(preset.name);
    }
    throw Error("--preset: '{}' is none of: {}", name, join(names));
}

}  // namespace tarn
