// Which clusters of triangles may be in view.
#pragma once

#include <cstdint>
#include <vector>

#include "world/world.h"

namespace tarn {

// Consecutive triangles of one instance, to be drawn at once.
struct TriangleRange {
    std::uint32_t instance = 0;
    std::uint32_t first_triangle = 0;  // within the mesh
    std::uint32_t triangle_count = 0;
};

// The ranges whose bounds meet the camera's frustum, in instance order; neighbouring clusters are joined.
// Conservative: nothing visible is left out, also where the picture is moved by up to `margin` of its half
// width and half height.
std::vector<TriangleRange> find_visible_ranges(const World& world, const CameraRecord& camera,
                                               const glm::vec2& margin = glm::vec2(0.0f));

}  // namespace tarn
