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

    // All views; the first is the picture itself.
    static std::vector<DisplayViewInfo> list_views();
};

}  // namespace tarn::api
