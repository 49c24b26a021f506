// Crates in small levels: they stand, are pushed, stop who does not push hard enough, and come to rest.
#include <gtest/gtest.h>
#include <tarn/scene.h>

#include <cmath>

#include "support/play_levels.h"

namespace {

using game::CRATE_HALF_M;
using game::CrateState;
using game::Simulation;
using game::StepInput;
using tarn::test::go_ahead;
using tarn::test::LevelBuilder;
using tarn::test::run_steps;

double speed_of(const CrateState& crate) {
    return std::hypot(crate.velocity.x, crate.velocity.y, crate.velocity.z);
}

bool is_same(const CrateState& a, const CrateState& b) {
    return a.position.x == b.position.x && a.position.y == b.position.y && a.position.z == b.position.z &&
           a.rotation.x == b.rotation.x && a.rotation.y == b.rotation.y && a.rotation.z == b.rotation.z;
}

// Whether all keep their place to the bit for a while.
void expect_at_rest(Simulation& simulation, const StepInput& input = {}) {
    const std::vector<CrateState> before = simulation.state().crates;
    for (int step = 0; step < 300; ++step) {
        simulation.step(input);
        for (std::size_t i = 0; i < before.size(); ++i)
            ASSERT_TRUE(is_same(before[i], simulation.state().crates[i]))
                << "crate " << i << ", step " << step;
    }
}

LevelBuilder& add_tower(LevelBuilder& builder, double x, double z, int count) {
    for (int i = 0; i < count; ++i) builder.crate({x, 3.0, z}, 0.1 * i);
    return builder;
}

TEST(Crates, StandOnOneAnotherAndFallAsleep) {
    LevelBuilder builder;
    builder.floor(20.0).crate({3.0, 1.0, -3.0}, 0.4);
    Simulation simulation(add_tower(builder, 0.0, -1.2, 4).level());
    ASSERT_EQ(simulation.state().crates.size(), 5u);
    const std::vector<CrateState> start = simulation.state().crates;
    run_steps(simulation, 240);
    for (int i = 0; i < 5; ++i) {
        const CrateState& crate = simulation.state().crates[std::size_t(i)];
        const double height = i == 0 ? CRATE_HALF_M : CRATE_HALF_M * (2 * (i - 1) + 1);
        EXPECT_NEAR(crate.position.y, height, 0.01);
        EXPECT_NEAR(crate.position.x, start[std::size_t(i)].position.x, 0.01);
        EXPECT_LT(speed_of(crate), 0.005);
    }
    expect_at_rest(simulation);
}

TEST(Crates, WhoWalksIntoOnePushesItAndStaysBehindIt) {
    Simulation simulation(LevelBuilder().floor(20.0).crate({0.0, 1.0, -1.5}).level());
    run_steps(simulation, 30);
    for (int i = 0; i < 180; ++i) {
        simulation.step(go_ahead(true));
        const double gap = simulation.state().player.feet.z - simulation.state().crates[0].position.z;
        ASSERT_GT(gap, CRATE_HALF_M + 0.25) << "step " << i;
    }
    const CrateState& crate = simulation.state().crates[0];
    EXPECT_LT(crate.position.z, -3.5);
    EXPECT_GT(crate.position.z, -7.5);  // it is heavy: slower than who runs free
    EXPECT_NEAR(crate.position.y, CRATE_HALF_M, 0.03);
    run_steps(simulation, 240);
    expect_at_rest(simulation);
}

TEST(Crates, OnesThatAreNotTouchedStay) {
    Simulation simulation(LevelBuilder().floor(20.0).crate({1.0, 1.0, -2.0}).level());
    run_steps(simulation, 200);
    expect_at_rest(simulation, go_ahead());
    EXPECT_LT(simulation.state().player.feet.z, -10.0);
}

TEST(Crates, AreHarderToPushTheMoreThereAre) {
    double moved[5] = {};
    for (const int count : {1, 3, 4}) {
        LevelBuilder builder;
        Simulation simulation(add_tower(builder.floor(20.0), 0.0, -1.2, count).level());
        run_steps(simulation, 30);
        run_steps(simulation, 90, go_ahead());
        EXPECT_NEAR(simulation.state().crates[0].position.y, CRATE_HALF_M, 0.01);  // pushed, not levered up
        moved[count] = -1.2 - simulation.state().crates[0].position.z;
    }
    EXPECT_GT(moved[1], 1.0);
    EXPECT_GT(moved[3], 0.1);
    EXPECT_LT(moved[3], moved[1] - 0.3);
    EXPECT_LT(moved[4], moved[3] - 0.3);
}

TEST(Crates, AWallStopsTheCrateAndItStopsWhoPushes) {
    for (const double yaw_rad : {0.0, 0.3}) {
        Simulation simulation(
            LevelBuilder().floor(20.0).wall_ahead(-3.0).crate({0.0, 1.0, -1.5}, yaw_rad).level());
        for (int i = 0; i < 400; ++i) {
            simulation.step(go_ahead(true));
            const game::Vec3 &feet = simulation.state().player.feet,
                             &p = simulation.state().crates[0].position;
            ASSERT_GT(p.z, -3.0 + CRATE_HALF_M - 0.05) << "step " << i;
            ASSERT_GT(feet.z, -2.75) << "step " << i;
            ASSERT_NEAR(feet.y, 0.0, 0.06) << "step " << i;
            ASSERT_GT(std::hypot(feet.x - p.x, feet.z - p.z), CRATE_HALF_M + 0.25) << "step " << i;
        }
        EXPECT_LT(simulation.state().crates[0].position.z, -2.2);
    }
}

TEST(Crates, BallsBounceOff) {
    LevelBuilder builder;
    builder.floor(20.0).start_at({0.0, 1.62, 0.0}, 0.0, -0.2);
    Simulation simulation(add_tower(builder, 0.0, -2.5, 3).level());
    run_steps(simulation, 200);
    StepInput input;
    input.throw_ball = true;
    simulation.step(input);
    double back = 0.0;
    for (int i = 0; i < 120; ++i) {
        simulation.step({});
        back = std::max(back, simulation.state().balls[0].velocity.z);
        ASSERT_GT(simulation.state().balls[0].position.z, -2.5);
    }
    EXPECT_GT(back, 1.5);  // a fifth of its speed, and what it had of spin
}

TEST(Crates, OneCanJumpOntoThemAndStand) {
    Simulation simulation(LevelBuilder().floor(20.0).crate({0.0, 1.0, -1.5}).level());
    run_steps(simulation, 200);
    StepInput input = go_ahead();
    for (int i = 0; i < 60 && simulation.state().player.feet.z > -1.1; ++i) {
        input.jump = i == 16;
        simulation.step(input);
    }
    EXPECT_NEAR(simulation.state().crates[0].position.z, -1.5, 0.02);  // who jumps does not push
    run_steps(simulation, 60);
    EXPECT_TRUE(simulation.state().player.is_on_ground);
    EXPECT_NEAR(simulation.state().player.feet.y, 2.0 * CRATE_HALF_M, 0.06);
    EXPECT_NEAR(simulation.state().player.feet.z, simulation.state().crates[0].position.z, 0.6);
    run_steps(simulation, 200);
    expect_at_rest(simulation);
    // And off again at the far side.
    run_steps(simulation, 60, go_ahead());
    EXPECT_NEAR(simulation.state().player.feet.y, 0.0, 0.06);
}

TEST(Crates, ThoseWithoutRoomOrFloorAreLeftOut) {
    Simulation simulation(LevelBuilder()
                              .floor(5.0)
                              .wall_ahead(-2.0)
                              .crate({0.0, 1.0, -2.1})  // in the wall
                              .crate({8.0, 1.0, 0.0})   // beside the floor
                              .crate({2.0, 1.0, 0.0})   // here
                              .crate({2.2, 0.2, 0.1})   // in that one
                              .level());
    ASSERT_EQ(simulation.state().crates.size(), 1u);
    EXPECT_NEAR(simulation.state().crates[0].position.x, 2.0, 1e-3);
}

TEST(Crates, WhatIsPushedOffTheLevelStartsAgain) {
    Simulation simulation(LevelBuilder().floor(3.0).crate({0.0, 1.0, -2.0}).level());
    bool fell = false, is_back = false;
    for (int i = 0; i < 400; ++i) {
        simulation.step(i < 100 ? go_ahead() : StepInput());
        const game::Vec3& p = simulation.state().crates[0].position;
        fell = fell || p.y < -3.0;
        is_back = fell && std::abs(p.y - CRATE_HALF_M) < 0.02 && std::abs(p.z + 2.0) < 0.1;
    }
    EXPECT_TRUE(fell);
    EXPECT_TRUE(is_back);
}

TEST(Crates, ARestartPutsThemBackAndEachCountsInTheHash) {
    Simulation simulation(LevelBuilder().floor(20.0).crate({0.0, 1.0, -1.5}).crate({2.0, 1.0, 0.0}).level());
    const std::vector<CrateState> start = simulation.state().crates;
    run_steps(simulation, 90, go_ahead());
    ASSERT_FALSE(is_same(start[0], simulation.state().crates[0]));
    game::PlayState other = simulation.state();
    other.crates[1].position.x += 1e-9;
    EXPECT_NE(compute_hash(other), compute_hash(simulation.state()));
    other = simulation.state();
    other.crates[0].rotation.y += 1e-9;
    EXPECT_NE(compute_hash(other), compute_hash(simulation.state()));
    StepInput restart;
    restart.restart = true;
    simulation.step(restart);
    for (std::size_t i = 0; i < start.size(); ++i)
        EXPECT_TRUE(is_same(start[i], simulation.state().crates[i]));
}

TEST(LanternCourt, HasADozenCratesThatStandFreeAndStayWhereTheyAre) {
    Simulation simulation(game::make_level(game::Scene::load(TARN_BUILD_DIR "/content/lantern_court.glb")));
    const std::vector<CrateState> start = simulation.state().crates;
    ASSERT_EQ(start.size(), 12u);
    run_steps(simulation, 300);
    for (std::size_t i = 0; i < start.size(); ++i) {
        const game::Vec3 &a = start[i].position, &b = simulation.state().crates[i].position;
        EXPECT_LT(std::hypot(a.x - b.x, a.y - b.y, a.z - b.z), 0.03) << "crate " << i;
        const double layer = (b.y / CRATE_HALF_M - 1.0) / 2.0;
        EXPECT_NEAR(layer, std::round(layer), 0.1) << "crate " << i << " at height " << b.y;
        EXPECT_GT(simulation.state().crates[i].rotation.w, 0.9) << "crate " << i;
    }
    expect_at_rest(simulation);
}

}  // namespace
