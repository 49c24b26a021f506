// The fly camera: directions, frame rates, limits, and the way to and from the renderer's camera.
#include "game/fly_camera.h"

#include <gtest/gtest.h>

#include <cmath>

namespace tarn {
namespace {

constexpr double HALF_TURN_RAD = 3.14159265358979323846;

World world_of_size(double size_m) {
    World world;
    world.bounds.add(glm::dvec3(0.0));
    world.bounds.add(glm::dvec3(size_m, 0.0, 0.0));
    return world;
}

void expect_near(const glm::dvec3& a, const glm::dvec3& b, double tolerance) {
    for (int i = 0; i < 3; ++i) EXPECT_NEAR(a[i], b[i], tolerance) << "component " << i;
}

glm::dvec3 way_of(const FlyCamera& camera, const FlyInput& input, double dt_s) {
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
    EXPECT_NEAR(glm::length(way_of(FlyCamera{}, {.move = {1, 1, 1}}, 1.0)), 1.0, 1e-12);
    EXPECT_NEAR(glm::length(way_of(FlyCamera{}, {.move = {0, 0, 0.25}}, 1.0)), 0.25, 1e-12);
}

TEST(FlyCamera, IsFasterWithShift) {
    EXPECT_NEAR(glm::length(way_of(FlyCamera{}, {.move = {0, 0, 1}, .fast = true}, 1.0)), 4.0, 1e-12);
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
    const CameraRecord record = camera_record(one_frame, World{}, 1.0);
    EXPECT_GT(record.forward.x, 0.1f);  // mouse to the right: looks to the right
    EXPECT_GT(record.forward.y, 0.1f);  // mouse up: looks up
    EXPECT_EQ(one_frame.position_ws, glm::dvec3(0.0));
}

TEST(FlyCamera, DoesNotTurnOverAtThePoles) {
    for (const double sign : {-1.0, 1.0}) {
        const FlyCamera camera = fly(FlyCamera{}, {.look_px = {0, sign * 1e5}}, 0.1);
        EXPECT_NEAR(camera.pitch_rad, -sign * 89.0 / 180.0 * HALF_TURN_RAD, 1e-12);
        EXPECT_GT(camera_record(camera, World{}, 1.0).up.y, 0.0f);
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
    EXPECT_NEAR(default_speed_m_s(world_of_size(30.0)), 3.0, 1e-12);
    EXPECT_NEAR(default_speed_m_s(world_of_size(3e4)), 3e3, 1e-9);
    EXPECT_EQ(default_speed_m_s(World{}), 1.0);
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
                const CameraRecord record = camera_record(camera, World{}, 16.0 / 9.0);
                const CameraRecord again = camera_record(start_flying(record, World{}), World{}, 16.0 / 9.0);
                expect_near(again.position, record.position, 1e-6);
                expect_near(again.right, record.right, 2e-6);
                expect_near(again.up, record.up, 2e-6);
                expect_near(again.forward, record.forward, 2e-6);
            }
        }
    }
}

TEST(FlyCamera, StartsFromCamerasThatLookStraightUpOrDown) {
    for (const float sign : {-1.0f, 1.0f}) {
        CameraRecord record;
        record.position = {0, 0, 0};
        record.forward = {0, sign, 0};
        record.up = {0.6f, 0, 0.8f};
        record.right = glm::cross(record.forward, record.up);
        record.orthographic = true;
        const FlyCamera camera = start_flying(record, World{});
        const CameraRecord again = camera_record(camera, World{}, 1.0);
        EXPECT_TRUE(again.orthographic);
        expect_near(again.forward, record.forward, 1e-6);
        expect_near(again.up, record.up, 1e-6);
        expect_near(again.right, record.right, 1e-6);
    }
}

TEST(FlyCamera, KeepsItsMillimetresFarFromTheWorldsOrigin) {
    World world;
    world.origin_ws = {1e5, -1e5, 1e5};
    FlyCamera camera = start_flying(
        look_at(world, world.origin_ws, world.origin_ws + glm::dvec3(0, 0, -1), 60.0, 1.0), world);
    camera.speed_m_s = 0.001;
    camera = fly(camera, {.move = {0, 0, 1}}, 1.0);
    expect_near(camera_record(camera, world, 1.0).position, {0, 0, -0.001}, 1e-9);
}

}  // namespace
}  // namespace tarn
