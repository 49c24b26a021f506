// A torch in the hand: where its flame is, and how it flickers.
#pragma once

#include <cstdint>

#include "../tarn_names.h"

namespace game {

// How far the flame is from the eye when nothing is in its way: right, below and ahead, of somebody who looks
// along `yaw_rad` and `pitch_rad`. Metres, world space.
Vec3 compute_torch_reach(double yaw_rad, double pitch_rad);

// How bright the flame is at a step, relative to its mean: 0.8 to 1.2, without jumps, never the same for
// long.
double compute_flicker(std::uint64_t step);

}  // namespace game
