// How a picture is made of what its frames sample.
#pragma once

namespace tarn {

enum class AntialiasMode {
    OFF,
    TAA,  // each frame samples another place of each pixel, and joins the picture of the last ones
};

struct AntialiasSettings {
    AntialiasMode mode = AntialiasMode::OFF;
    double scale = 1.0;  // width and height of what is rendered, as a share of the picture's

    bool runs() const { return mode != AntialiasMode::OFF; }

    bool operator==(const AntialiasSettings&) const = default;
};

}  // namespace tarn
