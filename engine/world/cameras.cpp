// Cameras: from the scene, from numbers, or a sensible view where there is none.
#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "world/world.h"

namespace tarn {
namespace {

CameraRecord make_camera(const glm::dvec3& position, const glm::dvec3& right, const glm::dvec3& up,
                         const glm::dvec3& forward, double half_height, double aspect, bool orthographic) {
    CameraRecord camera;
    camera.position = glm::vec3(position);
    camera.right = glm::vec3(glm::normalize(right) * (half_height * aspect));
    camera.up = glm::vec3(glm::normalize(up) * half_height);
    camera.forward = glm::vec3(glm::normalize(forward));
    camera.orthographic = orthographic;
    return camera;
}

// Lengths outside this range leave double precision when they are squared.
constexpr double MIN_AXIS = 1e-150;
constexpr double MAX_AXIS = 1e150;

void check_axes(const Scene& scene, CameraIndex index, const glm::dmat4& world_from_node) {
    for (int axis = 0; axis < 3; ++axis) {
        const double length = glm::length(glm::dvec3(world_from_node[axis]));
        if (length >= MIN_AXIS && length <= MAX_AXIS) continue;
        throw Error("camera {} '{}': axis {} of its node has length {}, so that it looks nowhere",
                    index.value, at(scene.cameras, index).name, "xyz"[axis], length);
    }
}

}  // namespace

std::optional<CameraRecord> scene_camera(const Scene& scene, const World& world, CameraIndex index,
                                         double aspect, double time_s) {
    if (!index.is_set() || index.value >= scene.cameras.size()) return std::nullopt;
    const Camera& camera = at(scene.cameras, index);
    const Pose pose = evaluate_pose(scene, time_s);
    const glm::dmat4& m = at(pose.world_from_node, camera.node);
    check_axes(scene, index, m);
    const double half_height =
        camera.orthographic ? camera.half_height_m : std::tan(0.5 * camera.vertical_fov_rad);
    return make_camera(glm::dvec3(m[3]) - world.origin_ws, glm::dvec3(m[0]), glm::dvec3(m[1]),
                       -glm::dvec3(m[2]), half_height, aspect, camera.orthographic);
}

CameraRecord look_at(const World& world, const glm::dvec3& position_ws, const glm::dvec3& target_ws,
                     double vertical_fov_deg, double aspect) {
    glm::dvec3 forward = target_ws - position_ws;
    forward = glm::length(forward) > 0.0 ? glm::normalize(forward) : glm::dvec3(0.0, 0.0, -1.0);
    const bool vertical = std::abs(forward.y) > 0.999999;
    const glm::dvec3 right =
        glm::cross(forward, vertical ? glm::dvec3(0.0, 0.0, -1.0) : glm::dvec3(0.0, 1.0, 0.0));
    return make_camera(position_ws - world.origin_ws, right, glm::cross(right, forward), forward,
                       std::tan(glm::radians(0.5 * vertical_fov_deg)), aspect, false);
}

CameraRecord default_camera(const World& world, double aspect) {
    constexpr double FOV_DEG = 45.0;
    const glm::dvec3 centre = world.bounds.empty() ? glm::dvec3(0.0) : world.bounds.centre();
    const double radius =
        world.bounds.empty() ? 1.0 : std::max(1e-6, 0.5 * glm::length(world.bounds.extent()));
    // Far enough that the bounding sphere fits the narrower side.
    const double half = std::atan(std::tan(glm::radians(0.5 * FOV_DEG)) * std::min(1.0, aspect));
    const glm::dvec3 towards_viewer = glm::normalize(glm::dvec3(0.45, 0.35, 1.0));
    const glm::dvec3 position = centre + towards_viewer * (radius / std::sin(half));
    return look_at(world, position + world.origin_ws, centre + world.origin_ws, FOV_DEG, aspect);
}

}  // namespace tarn
