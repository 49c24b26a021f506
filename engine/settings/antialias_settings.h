// How a picture is made of what its frames sample.
#pragma once

namespace tarn {

enum class AntialiasMode {
    OFF,
    JITTER,  // each frame samples another place of each pixel: for means over many frames
    TAA,     // each frame samples another place of each pixel, and joins the picture of the last ones
};

// What the picture is a mean of.
enum class AntialiasMean {
    RADIANCE,  // all energy is kept; lamps brighter than white keep their stairs
    DISPLAY,   // radiance as the eye sees it on the display: edges of lamps are smooth, and darker
};

struct AntialiasSettings {
    AntialiasMode mode = AntialiasMode::OFF;
    AntialiasMean mean = AntialiasMean::RADIANCE;
    double scale = 1.0;  // width and height of what is rendered, as a share of the picture's

    bool moves_samples() const { return mode != AntialiasMode::OFF; }
    bool joins_frames() const { return mode == AntialiasMode::TAA; }

    bool operator==(const AntialiasSettings&) const = default;
};

}  // namespace tarn
