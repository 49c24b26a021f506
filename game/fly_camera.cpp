#include "game/fly_camera.h"

#include <algorithm>
#include <cmath>

namespace tarn {
namespace {

constexpr double RADIANS_PER_PX = 0.003;
constexpr double PITCH_LIMIT_RAD = 89.0 / 180.0 * 3.14159265358979323846;
constexpr double FAST_FACTOR = 4.0;
constexpr double WHEEL_FACTOR = 1.25;
constexpr double CROSSING_TIME_S = 10.0;

struct Axes {
    glm::dvec3 right;
    glm::dvec3 up;
    glm::dvec3 forward;
};

Axes upright_axes(double yaw_rad, double pitch_rad) {
    Axes axes;
    axes.forward = {-std::sin(yaw_rad) * std::cos(pitch_rad), std::sin(pitch_rad),
                    -std::cos(yaw_rad) * std::cos(pitch_rad)};
    axes.right = {std::cos(yaw_rad), 0.0, -std::sin(yaw_rad)};
    axes.up = glm::cross(axes.right, axes.forward);
    return axes;
}

Axes camera_axes(const FlyCamera& camera) {
    const Axes upright = upright_axes(camera.yaw_rad, camera.pitch_rad);
    const double c = std::cos(camera.roll_rad);
    const double s = std::sin(camera.roll_rad);
    return {upright.right * c - upright.up * s, upright.up * c + upright.right * s, upright.forward};
}

FlyCamera look(FlyCamera camera, const glm::dvec2& look_px) {
    if (look_px == glm::dvec2(0.0)) return camera;
    camera.yaw_rad =
        std::remainder(camera.yaw_rad - look_px.x * RADIANS_PER_PX, 2.0 * 3.14159265358979323846);
    camera.pitch_rad =
        std::clamp(camera.pitch_rad - look_px.y * RADIANS_PER_PX, -PITCH_LIMIT_RAD, PITCH_LIMIT_RAD);
    return camera;
}

// Diagonals are no faster than straight ways.
glm::dvec3 velocity_m_s(const FlyCamera& camera, const FlyInput& input) {
    const Axes axes = camera_axes(camera);
    const glm::dvec3 direction =
        axes.right * input.move.x + glm::dvec3(0.0, 1.0, 0.0) * input.move.y + axes.forward * input.move.z;
    const double length = glm::length(direction);
    const double speed = camera.speed_m_s * (input.fast ? FAST_FACTOR : 1.0);
    return direction * (speed / std::max(1.0, length));
}

}  // namespace

FlyCamera fly(const FlyCamera& camera, const FlyInput& input, double dt_s) {
    FlyCamera next = look(camera, input.look_px);
    next.speed_m_s = std::clamp(camera.speed_m_s * std::pow(WHEEL_FACTOR, input.wheel_steps), 1e-6, 1e6);
    next.position_ws += velocity_m_s(next, input) * dt_s;
    return next;
}

CameraRecord camera_record(const FlyCamera& camera, const World& world, double aspect) {
    const Axes axes = camera_axes(camera);
    CameraRecord record;
    record.position = glm::vec3(camera.position_ws - world.origin_ws);
    record.right = glm::vec3(axes.right * (camera.half_height * aspect));
    record.up = glm::vec3(axes.up * camera.half_height);
    record.forward = glm::vec3(axes.forward);
    record.orthographic = camera.orthographic;
    return record;
}

FlyCamera start_flying(const CameraRecord& record, const World& world) {
    const glm::dvec3 forward = glm::normalize(glm::dvec3(record.forward));
    const glm::dvec3 up = glm::normalize(glm::dvec3(record.up));
    FlyCamera camera;
    camera.position_ws = glm::dvec3(record.position) + world.origin_ws;
    camera.pitch_rad = std::asin(std::clamp(forward.y, -1.0, 1.0));
    // Straight up or down the heading is where the top of the picture points.
    const bool vertical = std::abs(forward.y) > 0.999999;
    const glm::dvec3 heading = vertical ? up * (forward.y > 0.0 ? -1.0 : 1.0) : forward;
    camera.yaw_rad = std::atan2(-heading.x, -heading.z);
    const Axes upright = upright_axes(camera.yaw_rad, camera.pitch_rad);
    camera.roll_rad = std::atan2(glm::dot(up, upright.right), glm::dot(up, upright.up));
    camera.orthographic = record.orthographic;
    camera.half_height = glm::length(glm::dvec3(record.up));
    camera.speed_m_s = default_speed_m_s(world);
    return camera;
}

double default_speed_m_s(const World& world) {
    if (world.bounds.empty()) return 1.0;
    return std::max(1e-6, glm::length(world.bounds.extent()) / CROSSING_TIME_S);
}

}  // namespace tarn
