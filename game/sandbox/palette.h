// The colours of balls and lanterns.
#pragma once

#include <array>

#include "../play/simulation.h"
#include "../vectors.h"

namespace game {

// Radiance, W sr^-1 m^-2, as the lanterns of the court have it.
inline constexpr std::array<Vec3, PLAY_COLORS> PALETTE = {{{22.0, 9.0, 2.2},
                                                           {6.0, 16.0, 3.0},
                                                           {1.6, 6.0, 26.0},
                                                           {24.0, 2.0, 5.0},
                                                           {2.0, 15.0, 15.0},
                                                           {26.0, 4.0, 1.0},
                                                           {12.0, 2.0, 24.0},
                                                           {14.0, 13.0, 12.0}}};

inline double luminance(const Vec3& radiance) {
    return 0.2126 * radiance.x + 0.7152 * radiance.y + 0.0722 * radiance.z;
}

}  // namespace game
