// Balls that are thrown in small levels: they bounce, rest, stay outside of walls, and are not too many.
#include <gtest/gtest.h>

#include <cmath>

#include "support/play_levels.h"

namespace {

using game::BallState;
using game::Simulation;
using game::StepInput;
using tarn::test::LevelBuilder;
using tarn::test::run_steps;

StepInput throw_one() {
    StepInput input;
    input.throw_ball = true;
    return input;
}

int count_alive(const Simulation& simulation) {
    int count = 0;
    for (const BallState& ball : simulation.state().balls) count += ball.is_alive ? 1 : 0;
    return count;
}

// Per kilogram, of what flies: m^2/s^2.
double energy_of(const BallState& ball) {
    const game::Vec3& v = ball.velocity;
    return 0.5 * (v.x * v.x + v.y * v.y + v.z * v.z) + 9.81 * ball.position.y;
}

TEST(Balls, BounceLowerEachTimeAndComeToRest) {
    Simulation simulation(LevelBuilder().floor(60.0).start_at({0.0, 1.62, 0.0}, 0.0, 0.3).level());
    run_steps(simulation, 30);
    simulation.step(throw_one());
    const double start = energy_of(simulation.state().balls[0]);
    std::vector<double> peaks;
    double before = -1.0, previous = -1.0;
    for (int i = 0; i < 1500; ++i) {
        simulation.step({});
        const BallState& ball = simulation.state().balls[0];
        ASSERT_TRUE(ball.is_alive);
        ASSERT_LT(energy_of(ball), start * 1.01);
        // It sinks in by no more than its way in a quarter of a step.
        ASSERT_GT(ball.position.y, game::BALL_RADIUS_M - 11.0 / 240.0);
        if (previous > before && previous > ball.position.y && previous > 0.3) peaks.push_back(previous);
        before = previous;
        previous = ball.position.y;
    }
    ASSERT_GE(peaks.size(), 3u);
    for (std::size_t i = 1; i < peaks.size(); ++i) EXPECT_LT(peaks[i], peaks[i - 1]);
    // The second bounce keeps about the square of the restitution of 0.62: the floor's is 1.
    const double kept = (peaks[2] - game::BALL_RADIUS_M) / (peaks[1] - game::BALL_RADIUS_M);
    EXPECT_NEAR(kept, 0.62 * 0.62, 0.06);
    const BallState& ball = simulation.state().balls[0];
    EXPECT_NEAR(ball.position.y, game::BALL_RADIUS_M, 0.02);
    EXPECT_LT(std::hypot(ball.velocity.x, ball.velocity.y, ball.velocity.z), 0.01);
    EXPECT_LT(ball.position.z, -3.0);
}

TEST(Balls, RollAsTheyMove) {
    Simulation simulation(LevelBuilder().floor(60.0).level());
    run_steps(simulation, 30);
    simulation.step(throw_one());
    run_steps(simulation, 120);
    EXPECT_GT(std::abs(simulation.state().balls[0].rotation.x), 0.05);
}

TEST(Balls, FlyThroughNoThinWallFromAnyDistance) {
    for (int i = 0; i < 20; ++i) {
        const double z = -0.32 - 0.2 * i;
        Simulation simulation(
            LevelBuilder().floor(60.0).wall_ahead(z, 0.0, 30.0).start_at({0.0, 1.62, 0.0}, 0.04 * i).level());
        run_steps(simulation, 10);
        for (int step = 0; step < 120; ++step) {
            simulation.step(step % 20 == 0 ? throw_one() : StepInput());
            for (const BallState& ball : simulation.state().balls) {
                ASSERT_TRUE(!ball.is_alive || ball.position.z > z) << "wall at " << z;
            }
        }
    }
}

TEST(Balls, TheOldestMakesRoom) {
    Simulation simulation(LevelBuilder().room(10.0, 6.0).level());
    run_steps(simulation, 10);
    for (int i = 0; i < game::BALL_LIMIT; ++i) {
        EXPECT_EQ(count_alive(simulation), i);
        simulation.step(throw_one());
        run_steps(simulation, 4);
    }
    EXPECT_EQ(count_alive(simulation), game::BALL_LIMIT);
    run_steps(simulation, 600);
    simulation.step(throw_one());
    EXPECT_EQ(count_alive(simulation), game::BALL_LIMIT);
    const game::Vec3 eye = simulation.state().player.eye(), first = simulation.state().balls[0].position;
    EXPECT_LT(std::hypot(first.x - eye.x, first.y - eye.y, first.z - eye.z), 0.8);
}

TEST(Balls, WhoWalksIntoOnePushesIt) {
    Simulation simulation(LevelBuilder().floor(60.0).start_at({0.0, 1.62, 0.0}, 0.0, -1.4).level());
    run_steps(simulation, 10);
    simulation.step(throw_one());
    run_steps(simulation, 900);
    const double before = simulation.state().balls[0].position.z;
    run_steps(simulation, 120, tarn::test::go_ahead());
    ASSERT_LT(simulation.state().player.feet.z, -4.0);
    EXPECT_LT(simulation.state().balls[0].position.z, before - 0.5);
}

TEST(Balls, ThoseThatFallOffTheLevelAreGone) {
    Simulation simulation(LevelBuilder().floor(1.0).level());
    run_steps(simulation, 10);
    simulation.step(throw_one());
    EXPECT_EQ(count_alive(simulation), 1);
    run_steps(simulation, 240);
    EXPECT_EQ(count_alive(simulation), 0);
}

}  // namespace
