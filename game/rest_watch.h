// Whether what the viewer shows has come to rest.
#pragma once

#include <cstdint>

#include "fly_camera.h"
#include "tarn_names.h"
#include "window.h"

namespace game {

// What a frame depends on, besides its number and how it is shown.
struct ShownState {
    FlyCamera camera;
    Settings settings;
    std::uint32_t seed = 0;
    double time_s = 0.0;
    Size size;
};

class RestWatch {
  public:
    // Whether this state and those of the last REST_FRAMES frames were all the same: reuse and denoiser have
    // settled by then. Call once a frame.
    bool is_at_rest(const ShownState& state);

    static constexpr int REST_FRAMES = 12;

  private:
    ShownState last_;
    int frames_ = 0;
};

}  // namespace game
