// A camera that flies: keys move it, the mouse turns it. Pure functions of state, input and time.
#pragma once

#include "vectors.h"

namespace game {

// Yaw 0 looks along -Z; positive yaw turns left, positive pitch up, positive roll tilts the head to the
// right.
struct FlyCamera {
    Vec3 position_ws;
    double yaw_rad = 0.0;
    double pitch_rad = 0.0;
    double roll_rad = 0.0;
    bool orthographic = false;
    double half_height = 0.5;  // of the image plane: at distance 1 m, orthographic: in metres
    double speed_m_s = 1.0;
};

// What a person asks for during one frame.
struct FlyInput {
    Vec3 move{};  // right, up (of the world), forward; -1 to 1 each
    bool fast = false;
    Vec2 look_px{};            // mouse movement: right, down
    double wheel_steps = 0.0;  // positive: faster

    // Whether anything moves or turns the camera; the wheel alone does not.
    bool moves_camera() const;
};

// The camera after `dt_s` seconds of `input`. Movement is v * dt, so that equal times give equal ways at any
// frame rate; looking depends on the mouse's way alone. The pitch stays within 89 degrees, the speed within
// 1e-6 to 1e6 m/s.
FlyCamera fly(const FlyCamera& camera, const FlyInput& input, double dt_s);

// The camera as the engine takes it.
Camera to_camera(const FlyCamera& camera);

// The flying camera that sees what `camera` sees. One that looks straight up or down is taken as it is; fly()
// then brings it within its pitch limit.
FlyCamera start_flying(const Camera& camera, double speed_m_s);

// m/s: crosses the box in about ten seconds; 1 for an empty one.
double default_speed_m_s(const Box& bounds);

}  // namespace game
