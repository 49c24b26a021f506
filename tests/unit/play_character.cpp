// A person who walks through small levels: floors, walls, stairs, low beams.
#include <gtest/gtest.h>

#include <cmath>

#include "support/play_levels.h"

namespace {

using game::Simulation;
using game::StepInput;
using tarn::test::go_ahead;
using tarn::test::LevelBuilder;
using tarn::test::run_steps;

constexpr double RADIUS_M = 0.3;

TEST(Character, FallsToTheFloorAndStands) {
    Simulation simulation(LevelBuilder().floor(20.0).level());
    run_steps(simulation, 60);
    EXPECT_NEAR(simulation.state().player.feet.y, 0.0, 0.05);
    EXPECT_TRUE(simulation.state().player.is_on_ground);
    EXPECT_NEAR(simulation.state().player.eye().y, 1.62, 0.06);
}

TEST(Character, StartsOnTheFloorBelowAHighCamera) {
    Simulation simulation(LevelBuilder().floor(20.0).start_at({3.0, 12.0, -2.0}).level());
    EXPECT_NEAR(simulation.state().player.feet.y, 0.0, 0.05);
    EXPECT_NEAR(simulation.state().player.feet.x, 3.0, 1e-6);
}

TEST(Character, WalksAndRunsAtItsSpeed) {
    for (const bool run : {false, true}) {
        Simulation simulation(LevelBuilder().floor(50.0).level());
        run_steps(simulation, 60, go_ahead(run));
        const double before = simulation.state().player.feet.z;
        run_steps(simulation, 60, go_ahead(run));
        EXPECT_NEAR(before - simulation.state().player.feet.z, run ? 6.0 : 3.0, 0.1);
        EXPECT_NEAR(simulation.state().player.feet.y, 0.0, 0.05);
    }
}

TEST(Character, WalksSlowerWhereAStickAsksForIt) {
    StepInput half = go_ahead();
    half.forward = game::FULL_SPEED / 2;
    Simulation simulation(LevelBuilder().floor(50.0).level());
    run_steps(simulation, 60, half);
    const double before = simulation.state().player.feet.z;
    run_steps(simulation, 60, half);
    EXPECT_NEAR(before - simulation.state().player.feet.z, 1.5, 0.05);
}

TEST(Character, TurnsWithTheMouseAndWalksWhereItLooks) {
    Simulation simulation(LevelBuilder().floor(50.0).level());
    StepInput turn;
    turn.look_right = 714;  // by a quarter: 0.0022 rad a pixel
    simulation.step(turn);
    run_steps(simulation, 60, go_ahead());
    EXPECT_GT(simulation.state().player.feet.x, 2.0);
    EXPECT_NEAR(simulation.state().player.feet.z, 0.0, 0.05);
}

TEST(Character, AWallStopsItAndWithoutTheWallItGoesOn) {
    Simulation stopped(LevelBuilder().floor(50.0).wall_ahead(-5.0).level());
    run_steps(stopped, 180, go_ahead(true));
    EXPECT_LT(stopped.state().player.feet.z, -4.5);
    EXPECT_GT(stopped.state().player.feet.z, -5.0 + RADIUS_M - 0.03);
    Simulation free(LevelBuilder().floor(50.0).level());
    run_steps(free, 180, go_ahead(true));
    EXPECT_LT(free.state().player.feet.z, -12.0);
}

TEST(Character, RunsAndJumpsThroughNoThinWallAtAnyAngle) {
    for (int i = 0; i < 24; ++i) {
        const double yaw_rad = -1.45 + 2.9 * i / 23.0;
        Simulation simulation(
            LevelBuilder().floor(50.0).wall_ahead(-3.0).start_at({0.0, 1.62, 0.0}, yaw_rad).level());
        StepInput input = go_ahead(true);
        for (int step = 0; step < 240; ++step) {
            input.jump = step % 50 == 49;
            simulation.step(input);
            if (std::abs(simulation.state().player.feet.x) > 19.0) break;  // beside the wall's end
            ASSERT_GT(simulation.state().player.feet.z, -3.0 + RADIUS_M - 0.05) << "yaw " << yaw_rad;
        }
    }
}

TEST(Character, SlidesAlongAWall) {
    Simulation simulation(
        LevelBuilder().floor(50.0).wall_ahead(-2.0).start_at({0.0, 1.62, 0.0}, -0.7).level());
    run_steps(simulation, 180, go_ahead());
    EXPECT_GT(simulation.state().player.feet.x, 3.0);
}

// The court's stair has steps of 0.17 x 0.29 m.
TEST(Character, ClimbsStairsAndComesDownAgain) {
    LevelBuilder builder;
    builder.floor(50.0);
    const double rise_m = 0.17, run_m = 0.29;
    for (int i = 0; i < 12; ++i)
        builder.step_ahead(-2.0 - run_m * i, rise_m * i, rise_m * (i + 1), i == 11 ? 8.0 : run_m);
    Simulation simulation(builder.level());
    run_steps(simulation, 150, go_ahead());
    EXPECT_NEAR(simulation.state().player.feet.y, 12 * rise_m, 0.06);
    EXPECT_LT(simulation.state().player.feet.z, -5.5);
    StepInput back;
    back.forward = -game::FULL_SPEED;
    run_steps(simulation, 180, back);
    EXPECT_NEAR(simulation.state().player.feet.y, 0.0, 0.06);
}

TEST(Character, StepsOverWhatIsLowAndNotOverWhatIsHigh) {
    Simulation low(LevelBuilder().floor(50.0).step_ahead(-2.0, 0.0, 0.3, 20.0).level());
    run_steps(low, 120, go_ahead());
    EXPECT_NEAR(low.state().player.feet.y, 0.3, 0.06);
    Simulation high(LevelBuilder().floor(50.0).step_ahead(-2.0, 0.0, 0.6, 20.0).level());
    run_steps(high, 120, go_ahead());
    EXPECT_NEAR(high.state().player.feet.y, 0.0, 0.06);
    EXPECT_GT(high.state().player.feet.z, -2.0);
}

TEST(Character, JumpsOnceOntoWhatItCannotStepOver) {
    Simulation simulation(LevelBuilder().floor(50.0).step_ahead(-2.0, 0.0, 0.7, 20.0).level());
    run_steps(simulation, 30);
    StepInput jump;
    jump.jump = true;
    double highest = 0.0;
    for (int i = 0; i < 60; ++i) {
        simulation.step(i == 0 || i == 10 ? jump : StepInput());  // the second one in the air: no effect
        highest = std::max(highest, simulation.state().player.feet.y);
    }
    EXPECT_NEAR(highest, 1.0, 0.1);
    EXPECT_NEAR(simulation.state().player.feet.y, 0.0, 0.05);
    StepInput both = go_ahead();
    for (int i = 0; i < 120; ++i) {
        both.jump = i == 15;
        simulation.step(both);
    }
    EXPECT_NEAR(simulation.state().player.feet.y, 0.7, 0.06);
}

TEST(Character, CrouchesUnderABeamAndStandsUpOnlyBeyondIt) {
    // Its underside is at 1.3 m, from z = -2 to -4.
    const game::Level level = LevelBuilder()
                                  .floor(50.0)
                                  .wall_ahead(-2.0, 1.3, 4.0)
                                  .wall_ahead(-4.0, 1.3, 4.0)
                                  .quad({-20, 1.3, -2}, {20, 1.3, -2}, {20, 1.3, -4}, {-20, 1.3, -4})
                                  .level();
    Simulation upright(level);
    run_steps(upright, 180, go_ahead());
    EXPECT_GT(upright.state().player.feet.z, -2.0);

    Simulation crouched(level);
    StepInput low = go_ahead();
    low.crouch = true;
    run_steps(crouched, 120, low);
    EXPECT_LT(crouched.state().player.feet.z, -2.4);
    EXPECT_GT(crouched.state().player.feet.z, -3.7);
    run_steps(crouched, 20);
    EXPECT_TRUE(crouched.state().player.is_crouching);
    run_steps(crouched, 120, low);
    run_steps(crouched, 40);
    EXPECT_LT(crouched.state().player.feet.z, -4.3);
    EXPECT_FALSE(crouched.state().player.is_crouching);
    EXPECT_NEAR(crouched.state().player.eye_height_m, 1.62, 0.01);
}

TEST(Character, StandsOnAGroundOfItsOwnWhereNoFloorIsBelowTheStart) {
    Simulation simulation(LevelBuilder().wall_ahead(-3.0, -2.5, 4.0).level());
    run_steps(simulation, 120, go_ahead());
    EXPECT_NEAR(simulation.state().player.feet.y, -2.5, 0.05);
    EXPECT_TRUE(simulation.state().player.is_on_ground);
    EXPECT_GT(simulation.state().player.feet.z, -3.0);
}

TEST(Character, FallsOffTheLevelAndStartsAgain) {
    Simulation simulation(LevelBuilder().floor(3.0).level());
    bool fell = false;
    for (int i = 0; i < 400; ++i) {
        simulation.step(go_ahead(true));
        fell = fell || simulation.state().player.feet.y < -4.0;
        ASSERT_GT(simulation.state().player.feet.y, -7.0);
    }
    EXPECT_TRUE(fell);
}

}  // namespace
