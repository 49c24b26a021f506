// The colours of balls and lanterns.
#pragma once

#include <array>

#include "../play/simulation.h"
#include "../vectors.h"

namespace game {

// Radiance, W sr^-1 m^-2: less than that of the court's lanterns, and saturated, since what is much brighter
// than white loses its hue, and a ball comes close to the eye.
inline constexpr std::array<Vec3, PLAY_COLORS> PALETTE = {{{9.0, 2.2, 0.1},
                                                           {0.4, 6.5, 0.4},
                                                           {0.2, 1.0, 12.0},
                                                           {9.0, 0.25, 0.1},
                                                           {0.15, 5.0, 5.5},
                                                           {8.0, 0.3, 2.4},
                                                           {3.6, 0.25, 11.0},
                                                           {6.0, 5.4, 4.8}}};

inline double luminance(const Vec3& radiance) {
    return 0.2126 * radiance.x + 0.7152 * radiance.y + 0.0722 * radiance.z;
}

}  // namespace game
