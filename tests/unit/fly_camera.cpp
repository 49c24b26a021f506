// The fly camera: directions, frame rates, limits, and the way to and from the engine's camera.
#include "game/fly_camera.h"

#include <gtest/gtest.h>

#include <cmath>

namespace game {
namespace {

constexpr double HALF_TURN_RAD = 3.14159265358979323846;

void expect_near(const Vec3& a, const Vec3& b, double tolerance) {
    EXPECT_NEAR(a.x, b.x, tolerance);
    EXPECT_NEAR(a.y, b.y, tolerance);
    EXPECT_NEAR(a.z, b.z, tolerance);
}

Vec3 way_of(const FlyCamera& camera, const FlyInput& input, double dt_s) {
    return fly(camera, input, dt_s).position_ws - camera.position_ws;
}

TEST(FlyCamera, MovesAlongItsAxesAtItsSpeed) {
    FlyCamera camera;
    camera.speed_m_s = 3.0;
    expect_near(way_of(camera, {.move = {0, 0, 1}}, 2.0), {0, 0, -6}, 1e-12);
    expect_near(way_of(camera, {.move = {1, 0, 0}}, 2.0), {6, 0, 0}, 1e-12);
    expect_near(way_of(camera, {.move = {0, 1, 0}}, 2.0), {0, 6, 0}, 1e-12);
    camera.yaw_rad = 0.5 * HALF_TURN_RAD;  // looks along -X
    expect_near(way_of(camera, {.move = {0, 0, 1}}, 1.0), {-3, 0, 0}, 1e-12);
    expect_near(way_of(camera, {.move = {1, 0, 0}}, 1.0), {0, 0, -3}, 1e-12);
}

TEST(FlyCamera, FliesWhereItLooks) {
    FlyCamera camera;
    camera.pitch_rad = 0.5;
    expect_near(way_of(camera, {.move = {0, 0, 1}}, 1.0), {0, std::sin(0.5), -std::cos(0.5)}, 1e-12);
    // Up stays the world's up.
    expect_near(way_of(camera, {.move = {0, -1, 0}}, 1.0), {0, -1, 0}, 1e-12);
}

TEST(FlyCamera, IsNoFasterOnDiagonals) {
    EXPECT_NEAR(length(way_of(FlyCamera{}, {.move = {1, 1, 1}}, 1.0)), 1.0, 1e-12);
    EXPECT_NEAR(length(way_of(FlyCamera{}, {.move = {0, 0, 0.25}}, 1.0)), 0.25, 1e-12);
}

TEST(FlyCamera, IsFasterWithShift) {
    EXPECT_NEAR(length(way_of(FlyCamera{}, {.move = {0, 0, 1}, .fast = true}, 1.0)), 4.0, 1e-12);
}

TEST(FlyCamera, GoesEquallyFarAtAnyFrameRate) {
    FlyCamera start;
    start.yaw_rad = 0.3;
    start.pitch_rad = -0.2;
    const FlyInput input{.move = {0.5, 0.2, 1.0}};
    const FlyCamera once = fly(start, input, 1.0);
    for (const int frames : {2, 7, 100}) {
        FlyCamera camera = start;
        for (int i = 0; i < frames; ++i) camera = fly(camera, input, 1.0 / frames);
        expect_near(camera.position_ws, once.position_ws, 1e-12);
    }
}

TEST(FlyCamera, TurnsByTheMousesWayWhateverTheTime) {
    const FlyCamera one_frame = fly(FlyCamera{}, {.look_px = {100, -40}}, 0.5);
    FlyCamera many_frames;
    for (int i = 0; i < 20; ++i) many_frames = fly(many_frames, {.look_px = {5, -2}}, 0.01);
    EXPECT_NEAR(one_frame.yaw_rad, many_frames.yaw_rad, 1e-12);
    EXPECT_NEAR(one_frame.pitch_rad, many_frames.pitch_rad, 1e-12);
    const Camera camera = to_camera(one_frame);
    EXPECT_GT(camera.forward.x, 0.1);  // mouse to the right: looks to the right
    EXPECT_GT(camera.forward.y, 0.1);  // mouse up: looks up
    expect_near(one_frame.position_ws, {0, 0, 0}, 0.0);
}

TEST(FlyCamera, DoesNotTurnOverAtThePoles) {
    for (const double sign : {-1.0, 1.0}) {
        const FlyCamera camera = fly(FlyCamera{}, {.look_px = {0, sign * 1e5}}, 0.1);
        EXPECT_NEAR(camera.pitch_rad, -sign * 89.0 / 180.0 * HALF_TURN_RAD, 1e-12);
        EXPECT_GT(to_camera(camera).up.y, 0.0);
    }
}

TEST(FlyCamera, ChangesItsSpeedWithTheWheelWithinLimits) {
    EXPECT_NEAR(fly(FlyCamera{}, {.wheel_steps = 2.0}, 0.1).speed_m_s, 1.5625, 1e-12);
    EXPECT_NEAR(fly(FlyCamera{}, {.wheel_steps = -1.0}, 0.1).speed_m_s, 0.8, 1e-12);
    EXPECT_EQ(fly(FlyCamera{}, {.wheel_steps = 1000.0}, 0.1).speed_m_s, 1e6);
    EXPECT_EQ(fly(FlyCamera{}, {.wheel_steps = -1000.0}, 0.1).speed_m_s, 1e-6);
    EXPECT_FALSE((FlyInput{.wheel_steps = 1.0}.moves_camera()));
    EXPECT_TRUE((FlyInput{.look_px = {0, 1}}.moves_camera()));
}

TEST(FlyCamera, ScalesItsSpeedWithTheScene) {
    EXPECT_NEAR(default_speed_m_s({{0, 0, 0}, {30, 0, 0}}), 3.0, 1e-12);
    EXPECT_NEAR(default_speed_m_s({{1e5, 0, 0}, {1e5 + 3e4, 0, 0}}), 3e3, 1e-9);
    EXPECT_EQ(default_speed_m_s({{1, 1, 1}, {-1, -1, -1}}), 1.0);  // an empty scene
}

TEST(FlyCamera, SeesWhatTheCameraSawThatItStartedFrom) {
    FlyCamera camera;
    camera.position_ws = {1.0, 2.0, 3.0};
    camera.half_height = 0.7;
    for (const double yaw_rad : {-3.0, -0.4, 0.0, 1.2, 3.1}) {
        for (const double pitch_rad : {-1.5, -0.3, 0.0, 1.2}) {
            for (const double roll_rad : {-2.0, 0.0, 0.6}) {
                camera.yaw_rad = yaw_rad;
                camera.pitch_rad = pitch_rad;
                camera.roll_rad = roll_rad;
                Camera seen = to_camera(camera);
                const Camera expected = seen;
                // The lengths of a camera's directions do not matter.
                seen.forward = seen.forward * 3.0;
                seen.up = seen.up * 0.2;
                const Camera again = to_camera(start_flying(seen, 1.0));
                expect_near(again.position, expected.position, 1e-6);
                expect_near(again.right, expected.right, 2e-6);
                expect_near(again.up, expected.up, 2e-6);
                expect_near(again.forward, expected.forward, 2e-6);
                EXPECT_EQ(again.half_height, 0.7);
            }
        }
    }
}

TEST(FlyCamera, StartsFromCamerasThatLookStraightUpOrDown) {
    for (const double sign : {-1.0, 1.0}) {
        Camera start;
        start.forward = {0, sign, 0};
        start.up = {0.6, 0, 0.8};
        start.right = {0.8 * sign, 0, -0.6 * sign};  // forward x up
        start.orthographic = true;
        const Camera again = to_camera(start_flying(start, 2.0));
        EXPECT_TRUE(again.orthographic);
        expect_near(again.forward, start.forward, 1e-6);
        expect_near(again.up, start.up, 1e-6);
        expect_near(again.right, start.right, 1e-6);
        EXPECT_EQ(start_flying(start, 2.0).speed_m_s, 2.0);
    }
}

TEST(FlyCamera, KeepsItsMillimetresFarFromTheWorldsOrigin) {
    const Vec3 far = {1e5, -1e5, 1e5};
    FlyCamera camera = start_flying(Camera::look_at(far, {1e5, -1e5, 1e5 - 1}, 60.0), 0.001);
    camera = fly(camera, {.move = {0, 0, 1}}, 1.0);
    expect_near(to_camera(camera).position - far, {0, 0, -0.001}, 1e-9);
}

TEST(FlyCamera, MovesWhileKeysOrMouseAsk) {
    EXPECT_FALSE(FlyInput{}.moves_camera());
    EXPECT_TRUE((FlyInput{.move = {0, 0, -1}}.moves_camera()));
    EXPECT_TRUE((FlyInput{.move = {0, 1, 0}}.moves_camera()));
    EXPECT_TRUE((FlyInput{.look_px = {-1, 0}}.moves_camera()));
}

}  // namespace
}  // namespace game
