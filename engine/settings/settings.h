// Every tunable of the renderer: settings of each stage composed, and a row for each that feeds the command
// line, the panel and the JSON report.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "settings/antialias_settings.h"
#include "settings/denoise_settings.h"
#include "settings/direct_settings.h"
#include "settings/indirect_settings.h"
#include "settings/primary_settings.h"

namespace tarn {

struct RenderSettings {
    PrimarySettings primary;
    DirectSettings direct;
    IndirectSettings indirect;
    DenoiseSettings denoise;
    AntialiasSettings antialias;

    bool operator==(const RenderSettings&) const = default;
};

// The same light by an unbiased estimate that is fresh in every frame, for means that converge: RIS in place
// of ReSTIR, with a candidate along the BRDF; paths of full resolution without reuse or cache; no denoiser.
RenderSettings fresh_settings(const RenderSettings& settings);

// One row of the table. Values travel as doubles; a choice is the index into `choices`.
struct Setting {
    std::string name;      // "candidates": the option is --candidates
    std::string unit;      // "" where there is none
    std::string sentence;  // what it does, for --help and the panel
    double minimum = 0.0;
    double maximum = 0.0;
    std::vector<std::string> choices;  // empty: a number
    bool is_whole = true;              // a number without fraction
    std::function<double(const RenderSettings&)> get;
    std::function<void(RenderSettings&, double)> set;
    // Whether it changes anything beside these settings; empty: always. The panel hides what does not.
    std::function<bool(const RenderSettings&)> applies = {};

    // Reads a value as a user writes it. Throws Error that names the setting and what it accepts.
    void parse(RenderSettings& settings, const std::string& text) const;
    // The value as a user would write it.
    std::string format(const RenderSettings& settings) const;
};

const std::vector<Setting>& setting_table();

// A named set of settings.
struct Preset {
    std::string name;      // "fast"
    std::string sentence;  // what it is for
    RenderSettings settings;
    double energy_bound;  // how far the mean of many pictures may be from the reference's, as a share of it;
                          // 0: no bias. Measured in motion and at rest (tests/statistical/restir_motion.cpp).

    // "energy within 5 %", or "no bias".
    std::string describe_bias() const;
    // The sentence, and that.
    std::string describe() const { return sentence + "; " + describe_bias(); }
};

const std::vector<Preset>& preset_table();

// Throws Error that lists the names.
const Preset& find_preset(const std::string& name);

}  // namespace tarn
