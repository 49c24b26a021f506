// Tangents from the texture gradients of the triangles around each vertex.
#include "content/tangents.h"

#include <cmath>

namespace tarn::content {
namespace {

glm::vec3 any_orthogonal(const glm::vec3& n) {
    return glm::normalize(std::abs(n.y) < 0.9f ? glm::cross(glm::vec3(0, 1, 0), n)
                                               : glm::cross(glm::vec3(1, 0, 0), n));
}

}  // namespace

std::vector<glm::vec4> compute_tangents(const Shape& shape) {
    std::vector<glm::vec3> along_u(shape.positions.size(), glm::vec3(0.0f)), along_v = along_u;
    for (const glm::uvec3& t : shape.triangles) {
        const glm::vec3 e1 = shape.positions[t.y] - shape.positions[t.x];
        const glm::vec3 e2 = shape.positions[t.z] - shape.positions[t.x];
        const glm::vec2 d1 = shape.uvs[t.y] - shape.uvs[t.x], d2 = shape.uvs[t.z] - shape.uvs[t.x];
        const float sign = d1.x * d2.y - d2.x * d1.y < 0.0f ? -1.0f : 1.0f;
        for (int corner = 0; corner < 3; ++corner) {
            along_u[t[corner]] += sign * (e1 * d2.y - e2 * d1.y);
            along_v[t[corner]] += sign * (e2 * d1.x - e1 * d2.x);
        }
    }
    std::vector<glm::vec4> tangents;
    for (std::size_t i = 0; i < shape.positions.size(); ++i) {
        const glm::vec3 n = shape.normals[i];
        const glm::vec3 flat = along_u[i] - n * glm::dot(n, along_u[i]);
        const glm::vec3 t = glm::length(flat) > 1e-12f ? glm::normalize(flat) : any_orthogonal(n);
        const float handedness = glm::dot(glm::cross(n, t), along_v[i]) > 0.0f ? -1.0f : 1.0f;
        tangents.emplace_back(t, handedness);
    }
    return tangents;
}

}  // namespace tarn::content
