// What the denoiser can be told to do.
#pragma once

namespace tarn {

enum class DenoiseMode {
    OFF,
    SVGF,         // variance-guided, with a history that is cut short where the light changes
    SVGF_STATIC,  // without the latter
    BILATERAL,    // by surfaces alone
};

// Taps of a step of the filter.
enum class DenoiseKernel { CROSS, BOX3, BOX5 };

struct DenoiseSettings {
    DenoiseMode mode = DenoiseMode::OFF;
    int steps = 5;  // of the filter, each twice as wide as the one before
    DenoiseKernel kernel = DenoiseKernel::CROSS;
    int history = 32;  // frames

    bool runs() const { return mode != DenoiseMode::OFF; }
    bool knows_variance() const { return mode == DenoiseMode::SVGF || mode == DenoiseMode::SVGF_STATIC; }

    bool operator==(const DenoiseSettings&) const = default;
};

}  // namespace tarn
