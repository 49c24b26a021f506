// Tangents for normal-mapped shapes.
#pragma once

#include "content/shapes.h"

namespace tarn::content {

// One tangent for each vertex: the direction in which u grows, orthogonal to the normal; w is the sign that
// makes w * cross(normal, tangent) the direction in which v falls (v points down in glTF).
std::vector<glm::vec4> compute_tangents(const Shape& shape);

}  // namespace tarn::content
