// How a frame is shown to the eye.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace tarn::api {

// A way to show a frame.
struct DisplayViewInfo {
    std::string name;      // "shading normals"
    std::string sentence;  // what its colours mean
};

struct Display {
    std::string view = "radiance";  // which of list_views()
    // EV, for views of radiance; nullopt: an exposure that follows the pictures.
    std::optional<float> exposure_ev;
    double elapsed_s = 1.0 / 60.0;  // since the last frame: how far the exposure may follow
    // Which of list_tone_curves(): how radiance beyond the screen's range is brought into it.
    std::string tone = "neutral";
    double glare_strength = 0.0;  // of light that scatters around bright pixels; 1: as in the eye

    // All views; the first is the picture itself.
    static std::vector<DisplayViewInfo> list_views();
    // "clip": cut off at white; "neutral": Khronos PBR Neutral, which keeps hues and base colours.
    static std::vector<std::string> list_tone_curves();
};

}  // namespace tarn::api
