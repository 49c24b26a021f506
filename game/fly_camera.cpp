#include "fly_camera.h"

#include <algorithm>
#include <cmath>

namespace game {
namespace {

constexpr double PI = 3.14159265358979323846;
constexpr double RADIANS_PER_PX = 0.003;
constexpr double PITCH_LIMIT_RAD = 89.0 / 180.0 * PI;
constexpr double FAST_FACTOR = 4.0;
constexpr double WHEEL_FACTOR = 1.25;
constexpr double CROSSING_TIME_S = 10.0;

struct Axes {
    Vec3 right;
    Vec3 up;
    Vec3 forward;
};

Axes upright_axes(double yaw_rad, double pitch_rad) {
    Axes axes;
    axes.forward = {-std::sin(yaw_rad) * std::cos(pitch_rad), std::sin(pitch_rad),
                    -std::cos(yaw_rad) * std::cos(pitch_rad)};
    axes.right = {std::cos(yaw_rad), 0.0, -std::sin(yaw_rad)};
    axes.up = cross(axes.right, axes.forward);
    return axes;
}

Axes camera_axes(const FlyCamera& camera) {
    const Axes upright = upright_axes(camera.yaw_rad, camera.pitch_rad);
    const double c = std::cos(camera.roll_rad);
    const double s = std::sin(camera.roll_rad);
    return {upright.right * c - upright.up * s, upright.up * c + upright.right * s, upright.forward};
}

FlyCamera look(FlyCamera camera, const Vec2& look_px) {
    if (look_px.x == 0.0 && look_px.y == 0.0) return camera;
    camera.yaw_rad = std::remainder(camera.yaw_rad - look_px.x * RADIANS_PER_PX, 2.0 * PI);
    camera.pitch_rad =
        std::clamp(camera.pitch_rad - look_px.y * RADIANS_PER_PX, -PITCH_LIMIT_RAD, PITCH_LIMIT_RAD);
    return camera;
}

// Diagonals are no faster than straight ways.
Vec3 velocity_m_s(const FlyCamera& camera, const FlyInput& input) {
    const Axes axes = camera_axes(camera);
    const Vec3 direction =
        axes.right * input.move.x + Vec3{0.0, 1.0, 0.0} * input.move.y + axes.forward * input.move.z;
    const double speed = camera.speed_m_s * (input.fast ? FAST_FACTOR : 1.0);
    return direction * (speed / std::max(1.0, length(direction)));
}

}  // namespace

bool FlyInput::moves_camera() const {
    return move.x != 0.0 || move.y != 0.0 || move.z != 0.0 || look_px.x != 0.0 || look_px.y != 0.0;
}

FlyCamera fly(const FlyCamera& camera, const FlyInput& input, double dt_s) {
    FlyCamera next = look(camera, input.look_px);
    next.speed_m_s = std::clamp(camera.speed_m_s * std::pow(WHEEL_FACTOR, input.wheel_steps), 1e-6, 1e6);
    next.position_ws = next.position_ws + velocity_m_s(next, input) * dt_s;
    return next;
}

Camera to_camera(const FlyCamera& camera) {
    const Axes axes = camera_axes(camera);
    return {camera.position_ws, axes.right, axes.up, axes.forward, camera.half_height, camera.orthographic};
}

FlyCamera start_flying(const Camera& camera, double speed_m_s) {
    const Vec3 forward = normalize(camera.forward);
    FlyCamera flying;
    flying.position_ws = camera.position;
    flying.pitch_rad = std::asin(std::clamp(forward.y, -1.0, 1.0));
    // Straight up or down the heading is where the top of the picture points.
    const bool vertical = std::abs(forward.y) > 0.999999;
    const Vec3 heading = vertical ? camera.up * (forward.y > 0.0 ? -1.0 : 1.0) : forward;
    flying.yaw_rad = std::atan2(-heading.x, -heading.z);
    const Axes upright = upright_axes(flying.yaw_rad, flying.pitch_rad);
    flying.roll_rad = std::atan2(dot(camera.up, upright.right), dot(camera.up, upright.up));
    flying.orthographic = camera.orthographic;
    flying.half_height = camera.half_height;
    flying.speed_m_s = speed_m_s;
    return flying;
}

double default_speed_m_s(const Box& bounds) {
    if (bounds.lower.x > bounds.upper.x) return 1.0;
    return std::max(1e-6, length(bounds.upper - bounds.lower) / CROSSING_TIME_S);
}

}  // namespace game
