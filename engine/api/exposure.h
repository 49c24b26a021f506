// Automatic exposure of a picture that is shown as it is made.
#pragma once

#include <cstdint>

#include "gl/texture.h"

namespace tarn::api {

// Follows the pictures' luminance within about ten frames, so that it neither jumps nor flickers.
class AutoExposure {
  public:
    // The exposure for this picture, EV. `frame` counts the pictures that were rendered: each is looked at
    // once.
    float follow(const Texture2D& radiance, std::uint64_t frame);

  private:
    float exposure_ev_ = 0.0f;
    std::uint64_t frame_ = 0;  // the last one that was looked at; 0: none
};

}  // namespace tarn::api
