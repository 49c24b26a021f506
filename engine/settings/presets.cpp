// The presets.
#include <fmt/ranges.h>

#include "core/error.h"
#include "settings/settings.h"

namespace tarn {
namespace {

// Near neighbours mostly see the same lights, so reuse adds little bias. Without feedback less of it returns
// in the next frame.
constexpr double PRESET_RADIUS_PX = 16.0;

// Path samples are reused by the rules of light samples, where indirect light is on. What is kept for many
// frames must not be worth much more than its lamp: all paths look for lamps at their end.
void reuse_paths_alike(RenderSettings& settings) {
    settings.indirect.reuse = settings.direct.reuse;
    settings.indirect.light_rays = 1.0;
}

RenderSettings fast_settings() {
    RenderSettings settings;
    DirectSettings& s = settings.direct;
    s.mode = DirectMode::RESTIR;
    s.light_selection = LightSelection::TILES;
    s.candidates = 8;
    s.reuse.neighbours = 1;
    s.reuse.radius_px = PRESET_RADIUS_PX;
    s.reuse.feedback = false;
    s.reuse.mis = Mis::BALANCE;
    s.reuse.final_visibility = FinalVisibility::AVERAGED;
    s.reuse.shade = SampleShading::ALL;
    s.reuse.age_cap = 30;
    reuse_paths_alike(settings);
    settings.indirect.resolution = IndirectResolution::HALF;
    settings.indirect.candidates = 1;
    return settings;
}

// For people who want to see the scene: all light, denoised. No sample is reused: reused ones are alike over
// time and among neighbours, and what a denoiser needs is independent ones, best of all blue noise
// (docs/denoising.md has the measurement). Mirrors need the candidate along the BRDF.
RenderSettings clean_settings() {
    RenderSettings settings = fast_settings();
    settings.direct.mode = DirectMode::RIS;
    settings.direct.candidates = 16;
    settings.direct.brdf_candidate = true;
    settings.indirect.mode = IndirectMode::PATH;
    settings.indirect.noise = NoiseKind::BLUE;
    settings.denoise.mode = DenoiseMode::SVGF;
    settings.antialias.mode = AntialiasMode::TAA;
    return settings;
}

RenderSettings balanced_settings() {
    RenderSettings settings;
    DirectSettings& s = settings.direct;
    s.mode = DirectMode::RESTIR;
    s.light_selection = LightSelection::TILES;
    s.candidates = 16;
    s.brdf_candidate = true;
    s.reuse.neighbours = 3;
    s.reuse.radius_px = PRESET_RADIUS_PX;
    s.reuse.feedback = false;
    s.reuse.mis = Mis::PAIRWISE;
    s.reuse.age_cap = 30;
    reuse_paths_alike(settings);
    return settings;
}

RenderSettings fine_settings() {
    RenderSettings settings = balanced_settings();
    DirectSettings& s = settings.direct;
    s.light_selection = LightSelection::TREE;
    s.candidates = 4;
    s.per_channel = true;
    return settings;
}

RenderSettings unbiased_settings() {
    RenderSettings settings = balanced_settings();
    DirectSettings& s = settings.direct;
    s.reuse.mis_visibility = true;
    s.reuse.shade = SampleShading::ALL;
    s.reuse.age_cap = 0;
    reuse_paths_alike(settings);
    return settings;
}

RenderSettings student_settings() {
    RenderSettings settings;
    DirectSettings& s = settings.direct;
    s.mode = DirectMode::RESTIR;
    s.light_selection = LightSelection::UNIFORM;
    s.candidates = 32;
    s.reuse.neighbours = 5;
    s.reuse.radius_px = 10.0;
    s.reuse.motion_cap = s.reuse.confidence_cap;
    s.reuse.mis = Mis::ONE_OVER_M;
    return settings;
}

}  // namespace

const std::vector<Preset>& preset_table() {
    static const std::vector<Preset> table = {
        {"clean",
         "RIS, one ray along the BRDF, and a path for each 2 x 2 pixels: independent samples, denoised and "
         "antialiased",
         clean_settings(), 0.05},
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
    throw Error("--preset: '{}' is none of: {}", name, fmt::join(names, ", "));
}

}  // namespace tarn
