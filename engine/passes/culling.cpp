#include "passes/culling.h"

#include <array>

namespace tarn {
namespace {

// Points p with dot(normal, p) + offset >= 0 are inside.
using Plane = glm::vec4;

// Left, right, top, bottom and the plane behind the camera. No far plane: the depth range is infinite.
std::array<Plane, 5> frustum_planes(const CameraRecord& camera, const glm::vec2& margin) {
    const glm::vec3 right = camera.right / glm::dot(camera.right, camera.right);
    const glm::vec3 up = camera.up / glm::dot(camera.up, camera.up);
    // x / depth (orthographic: x) within [-1, 1] and the margin, and the same for y.
    const glm::vec2 reach = 1.0f + margin;
    const glm::vec3 depth = camera.orthographic ? glm::vec3(0.0f) : camera.forward;
    std::array<glm::vec3, 5> normals = {depth * reach.x - right, depth * reach.x + right,
                                        depth * reach.y - up, depth * reach.y + up, camera.forward};
    std::array<Plane, 5> planes;
    for (int i = 0; i < 5; ++i) {
        const float constant = i < 4 && camera.orthographic ? reach[i / 2] : 0.0f;
        const float offset = constant - glm::dot(normals[i], camera.position);
        planes[i] = Plane(normals[i], offset);
    }
    return planes;
}

bool may_be_inside(const std::array<Plane, 5>& planes, const glm::vec3& lower, const glm::vec3& upper) {
    const glm::vec3 centre = 0.5f * (lower + upper);
    // A little larger, for the rounding of the planes.
    const glm::vec3 half = 0.5f * (upper - lower) + 1e-5f * (glm::abs(lower) + glm::abs(upper));
    for (const Plane& plane : planes) {
        const glm::vec3 normal(plane);
        if (glm::dot(normal, centre) + plane.w + glm::dot(glm::abs(normal), half) < 0.0f) return false;
    }
    return true;
}

std::array<Plane, 5> to_object_space(const std::array<Plane, 5>& planes, const glm::mat4& world_from_object) {
    std::array<Plane, 5> result;
    for (int i = 0; i < 5; ++i) result[i] = glm::transpose(world_from_object) * planes[i];
    return result;
}

}  // namespace

std::vector<TriangleRange> find_visible_ranges(const World& world, const CameraRecord& camera,
                                               const glm::vec2& margin) {
    const std::array<Plane, 5> planes_ws = frustum_planes(camera, margin);
    std::vector<TriangleRange> ranges;
    for (std::uint32_t i = 0; i < world.instances.size(); ++i) {
        const WorldInstance& instance = world.instances[i];
        const std::array<Plane, 5> planes_os = to_object_space(planes_ws, instance.world_from_object);
        bool join = false;
        for (const Cluster& cluster : world.meshes[instance.mesh].clusters) {
            const bool visible = may_be_inside(planes_os, cluster.lower_os, cluster.upper_os);
            if (visible && join) {
                ranges.back().triangle_count += cluster.triangle_count;
            } else if (visible) {
                ranges.push_back({i, cluster.first_triangle, cluster.triangle_count});
            }
            join = visible;
        }
    }
    return ranges;
}

}  // namespace tarn
