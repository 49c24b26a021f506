// Cameras and placements as plain numbers.
#include "tarn/camera.h"

#include <cmath>

#include "api/guard.h"
#include "api/scene_state.h"

namespace tarn::api {
namespace {

// Lengths outside this range leave double precision when they are squared.
constexpr double MIN_LENGTH = 1e-150;
constexpr double MAX_LENGTH = 1e150;

glm::dvec3 normalize_axis(const Vec3& axis, const char* name) {
    const glm::dvec3 v = from_public(axis);
    const double length = glm::length(v);
    if (!(length >= MIN_LENGTH && length <= MAX_LENGTH))
        throw tarn::Error("the camera's direction '{}' has length {}", name, length);
    return glm::normalize(v);
}

}  // namespace

Rotation Rotation::about(const Vec3& axis, double angle_rad) {
    const glm::dvec3 v = from_public(axis);
    const double length = glm::length(v);
    if (!(length > 0.0)) return {};
    const glm::dvec3 xyz = v * (std::sin(0.5 * angle_rad) / length);
    return {xyz.x, xyz.y, xyz.z, std::cos(0.5 * angle_rad)};
}

Camera Camera::look_at(const Vec3& position, const Vec3& target, double vertical_fov_deg) {
    if (!(vertical_fov_deg > 0.0 && vertical_fov_deg < 180.0)) {
        throw Error(fmt::format("the camera's field of view is {} degrees, it must lie between 0 and 180",
                                vertical_fov_deg));
    }
    // As tarn::look_at does it, so that both give the same bits.
    glm::dvec3 forward = from_public(target) - from_public(position);
    forward = glm::length(forward) > 0.0 ? glm::normalize(forward) : glm::dvec3(0.0, 0.0, -1.0);
    const bool vertical = std::abs(forward.y) > 0.999999;
    const glm::dvec3 right =
        glm::cross(forward, vertical ? glm::dvec3(0.0, 0.0, -1.0) : glm::dvec3(0.0, 1.0, 0.0));
    Camera camera;
    camera.position = position;
    camera.right = to_public(right);
    camera.up = to_public(glm::cross(right, forward));
    camera.forward = to_public(forward);
    camera.half_height = std::tan(glm::radians(0.5 * vertical_fov_deg));
    return camera;
}

CameraRecord make_record(const Camera& camera, const World& world, double aspect) {
    if (!(camera.half_height > 0.0 && camera.half_height < MAX_LENGTH))
        throw tarn::Error("the camera's half_height is {}, it must be above 0", camera.half_height);
    CameraRecord record;
    record.position = glm::vec3(from_public(camera.position) - world.origin_ws);
    record.right = glm::vec3(normalize_axis(camera.right, "right") * (camera.half_height * aspect));
    record.up = glm::vec3(normalize_axis(camera.up, "up") * camera.half_height);
    record.forward = glm::vec3(normalize_axis(camera.forward, "forward"));
    record.orthographic = camera.orthographic;
    return record;
}

}  // namespace tarn::api
