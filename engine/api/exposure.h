// Automatic exposure of a picture that is shown as it is made.
#pragma once

#include <cstdint>

#include "gl/texture.h"

namespace tarn::api {

// Follows the pictures' luminance within about a second, so that it neither jumps nor flickers.
class AutoExposure {
  public:
    // The exposure for this picture, EV. `frame` counts the pictures that were rendered: each is looked at
    // once. `elapsed_s`: since the picture before.
    float follow(const Texture2D& radiance, std::uint64_t frame, double elapsed_s);

    // Starts from `exposure_ev`, which was chosen for a picture, and returns it.
    float start_from(float exposure_ev) { return exposure_ev_ = exposure_ev; }

  private:
    float exposure_ev_ = 0.0f;
    std::uint64_t frame_ = 0;  // the last one that was looked at; 0: none
    double elapsed_s_ = 0.0;   // since then
};

}  // namespace tarn::api
