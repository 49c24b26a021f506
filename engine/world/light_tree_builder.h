// The shape of a light tree: which lights are siblings. Private to this folder.
#pragma once

#include <cstdint>
#include <vector>

#include "world/light_bounds.h"

namespace tarn {

struct BoundedLight {
    LightBounds bounds;
    std::uint32_t light = 0;
};

// Chooses where to divide `lights` (two at least) and sorts them so: returns how many go left, between 1 and
// count - 1. By the surface area and orientation heuristic over binned centres (Conty Estevez and Kulla 2018,
// section 4.4); in the middle where there is no better place, or where no more than `max_levels` levels may
// follow.
std::size_t divide_lights(BoundedLight* lights, std::size_t count, std::uint32_t max_levels);

}  // namespace tarn
