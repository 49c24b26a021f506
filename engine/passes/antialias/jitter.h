// Where in its pixels a frame samples.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>

namespace tarn {

// From the centre of a pixel, in pixels, within +-0.5: place `frame` modulo `count` of the first `count`
// points of Sobol's sequence in two dimensions, moved so that their mean is the centre. `count` is a power of
// two: then every box of 2^-a x 2^-b pixels that holds a point on average holds one, over all points and over
// each aligned power of two of them (Sobol 1967; a (0,2)-sequence in base 2).
glm::vec2 find_jitter(std::uint32_t frame, int count);

}  // namespace tarn
