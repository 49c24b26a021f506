// The sandbox's state as a whole: the same inputs give the same bits, and no inputs break it.
#include <gtest/gtest.h>
#include <tarn/scene.h>

#include <cmath>

#include "support/play_levels.h"

namespace {

using game::compute_hash;
using game::PlayState;
using game::Simulation;
using game::StepInput;
using tarn::test::LevelBuilder;
using tarn::test::RandomPlayer;
using tarn::test::run_steps;

// A room with a stair, a ramp, a low wall and crates.
game::Level make_playground() {
    LevelBuilder builder;
    builder.room(8.0, 5.0).wall_ahead(-3.0, 0.0, 0.5).lantern({1.0, 2.2, 0.0}, true);
    builder.quad({2, 0, 6}, {6, 0, 6}, {6, 2, 2}, {2, 2, 2}).quad({2, 2, 2}, {6, 2, 2}, {6, 2, 0}, {2, 2, 0});
    for (int i = 0; i < 9; ++i) builder.crate({-4.0 + 0.9 * (i % 3), 3.0, 2.0 + 0.3 * (i / 3)}, 0.1 * i);
    return builder.level();
}

std::uint64_t play(const game::Level& level, std::uint32_t seed, int steps) {
    Simulation simulation(level);
    RandomPlayer player(seed);
    for (int i = 0; i < steps; ++i) simulation.step(player.next());
    return compute_hash(simulation.state());
}

bool is_finite(const PlayState& state) {
    const auto is_point = [](const game::Vec3& p) {
        return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z);
    };
    bool finite = is_point(state.player.feet) && std::isfinite(state.player.eye_height_m) &&
                  std::isfinite(state.player.yaw_rad) && std::isfinite(state.player.pitch_rad);
    for (const game::BallState& ball : state.balls) {
        finite =
            finite && is_point(ball.position) && is_point(ball.velocity) && std::isfinite(ball.rotation.w);
    }
    for (const game::CrateState& crate : state.crates) {
        finite =
            finite && is_point(crate.position) && is_point(crate.velocity) && std::isfinite(crate.rotation.w);
    }
    return finite;
}

TEST(Simulation, TenThousandStepsTwiceHaveTheSameBits) {
    const game::Level level = make_playground();
    EXPECT_EQ(play(level, 1, 10000), play(level, 1, 10000));
    EXPECT_NE(play(level, 1, 1000), play(level, 2, 1000));
}

TEST(Simulation, OneInputThatDiffersChangesTheState) {
    const game::Level level = make_playground();
    Simulation a(level), b(level);
    StepInput nudge;
    nudge.look_right = 1;
    a.step(nudge);
    b.step({});
    EXPECT_NE(compute_hash(a.state()), compute_hash(b.state()));
}

TEST(Simulation, ARestartIsAsTheStart) {
    const game::Level level = make_playground();
    Simulation simulation(level);
    const std::uint64_t start = compute_hash(simulation.state());
    RandomPlayer player(3);
    for (int i = 0; i < 500; ++i) simulation.step(player.next());
    EXPECT_NE(compute_hash(simulation.state()), start);
    StepInput restart;
    restart.restart = true;
    simulation.step(restart);
    EXPECT_EQ(compute_hash(simulation.state()), start);
}

TEST(Simulation, TwentyThousandRandomStepsStayFiniteAndInTheRoom) {
    Simulation simulation(make_playground());
    RandomPlayer player(7);
    int outside = 0;
    for (int i = 0; i < 20000; ++i) {
        simulation.step(player.next());
        const PlayState& state = simulation.state();
        ASSERT_TRUE(is_finite(state)) << "step " << i;
        const game::Vec3& feet = state.player.feet;
        ASSERT_LT(std::max(std::abs(feet.x), std::abs(feet.z)), 8.0) << "step " << i;
        ASSERT_GT(feet.y, -0.1) << "step " << i;
        ASSERT_LT(feet.y, 5.0) << "step " << i;
        for (const game::BallState& ball : state.balls) {
            const game::Vec3& p = ball.position;
            if (ball.is_alive && (std::max(std::abs(p.x), std::abs(p.z)) > 8.0 || p.y < 0.0 || p.y > 5.0))
                ++outside;
        }
        for (const game::CrateState& crate : state.crates) {
            const game::Vec3& p = crate.position;
            if (std::max(std::abs(p.x), std::abs(p.z)) > 8.0 || p.y < 0.0 || p.y > 5.0) ++outside;
        }
    }
    EXPECT_EQ(outside, 0);
}

// So narrow that balls are squeezed against thin walls, so low that who jumps hits the ceiling.
TEST(Simulation, NobodyAndNoBallGetsOutOfANarrowLowRoom) {
    constexpr double HALF_M = 1.5, HEIGHT_M = 2.6;
    const auto is_inside = [](const game::Vec3& p) {
        return std::max(std::abs(p.x), std::abs(p.z)) < HALF_M && p.y > 0.0 && p.y < HEIGHT_M;
    };
    for (const std::uint32_t seed : {1u, 2u, 3u}) {
        LevelBuilder builder;
        builder.room(HALF_M, HEIGHT_M)
            .crate({-0.7, 1.0, -0.8})
            .crate({0.8, 1.0, -0.7})
            .crate({0.0, 1.0, 0.9});
        Simulation simulation(builder.level());
        ASSERT_EQ(simulation.state().crates.size(), 3u);
        RandomPlayer player(seed);
        for (int i = 0; i < 2000; ++i) {
            StepInput input = player.next();
            input.throw_ball = i % 10 == 0 && i < 600;
            simulation.step(input);
            ASSERT_TRUE(is_inside(simulation.state().player.eye())) << "seed " << seed << ", step " << i;
            for (const game::BallState& ball : simulation.state().balls)
                ASSERT_TRUE(!ball.is_alive || is_inside(ball.position)) << "seed " << seed << ", step " << i;
            for (const game::CrateState& crate : simulation.state().crates)
                ASSERT_TRUE(is_inside(crate.position)) << "seed " << seed << ", step " << i;
        }
    }
}

TEST(Simulation, AnEmptyLevelAndOneFarAwayDoNoHarm) {
    Simulation nothing{game::Level()};
    run_steps(nothing, 120, tarn::test::go_ahead(true));
    EXPECT_TRUE(is_finite(nothing.state()));

    game::Level far = LevelBuilder().floor(20.0).level();
    const game::Vec3 away{1e6, -2e5, 3e6};
    far.origin = away;
    far.start_eye = {away.x, away.y + 1.62, away.z};
    far.bounds = {{away.x - 20, away.y, away.z - 20}, {away.x + 20, away.y, away.z + 20}};
    Simulation simulation(far);
    run_steps(simulation, 60, tarn::test::go_ahead());
    EXPECT_NEAR(simulation.state().player.feet.y - away.y, 0.0, 0.05);
    EXPECT_NEAR(simulation.state().player.feet.z - away.z, -2.9, 0.15);
}

TEST(Relighting, LanternsAreLitFromNearbyAndCounted) {
    Simulation simulation(LevelBuilder()
                              .floor(20.0)
                              .lantern({0.0, 2.2, -2.0}, true)
                              .lantern({0.0, 2.2, -9.0}, true)
                              .lantern({9.0, 2.2, 9.0}, false)
                              .level());
    EXPECT_EQ(simulation.state().dead_count, 2);
    EXPECT_EQ(simulation.state().relit_count, 0);
    StepInput use;
    use.use = true;
    simulation.step(use);
    EXPECT_EQ(simulation.state().aimed_lantern, 0);
    EXPECT_EQ(simulation.state().relit_count, 1);
    EXPECT_EQ(simulation.state().finished_step, 0u);
    simulation.step(use);
    EXPECT_EQ(simulation.state().relit_count, 0);
    simulation.step(use);
    run_steps(simulation, 135, tarn::test::go_ahead());
    simulation.step(use);
    EXPECT_EQ(simulation.state().aimed_lantern, 1);
    EXPECT_EQ(simulation.state().relit_count, 2);
    EXPECT_EQ(simulation.state().finished_step, simulation.state().step);
}

TEST(Relighting, TheWheelRecoloursAndDimsWhatIsLookedAtElseTheNextBall) {
    Simulation simulation(LevelBuilder().floor(20.0).lantern({0.0, 2.2, -2.0}, false).level());
    StepInput wheel;
    wheel.wheel = -1;
    simulation.step(wheel);
    EXPECT_EQ(simulation.state().lanterns[0].color, game::PLAY_COLORS - 1);
    wheel.wheel = 2;
    simulation.step(wheel);
    EXPECT_EQ(simulation.state().lanterns[0].color, 0);
    wheel.run = true;
    simulation.step(wheel);
    EXPECT_NEAR(simulation.state().lanterns[0].brightness, 1.25 * 1.25, 1e-9);
    EXPECT_EQ(simulation.state().next_color, 0);
    StepInput turn;
    turn.look_right = 1400;
    simulation.step(turn);
    EXPECT_EQ(simulation.state().aimed_lantern, -1);
    wheel.wheel = 3;
    simulation.step(wheel);
    EXPECT_EQ(simulation.state().next_color, 3);
}

TEST(Torch, IsTakenOutAndPutAway) {
    Simulation simulation(LevelBuilder().floor(20.0).level());
    run_steps(simulation, 30);
    EXPECT_FALSE(simulation.state().torch.is_lit);
    EXPECT_EQ(simulation.state().torch.brightness, 0.0);
    StepInput torch;
    torch.torch = true;
    simulation.step(torch);
    EXPECT_TRUE(simulation.state().torch.is_lit);
    // To the right of the eye and ahead of it.
    const game::Vec3 eye = simulation.state().player.eye(), flame = simulation.state().torch.position;
    EXPECT_GT(flame.x, eye.x + 0.2);
    EXPECT_LT(flame.z, eye.z - 0.2);
    EXPECT_LT(std::hypot(flame.x - eye.x, flame.y - eye.y, flame.z - eye.z), 0.8);
    StepInput turn;
    turn.look_right = 714;  // by a quarter
    simulation.step(turn);
    EXPECT_GT(simulation.state().torch.position.z, eye.z + 0.2);
    EXPECT_TRUE(simulation.state().torch.is_lit);
    simulation.step(torch);
    EXPECT_FALSE(simulation.state().torch.is_lit);
    EXPECT_EQ(simulation.state().torch.brightness, 0.0);
    simulation.step(torch);
    StepInput restart;
    restart.restart = true;
    simulation.step(restart);
    EXPECT_FALSE(simulation.state().torch.is_lit);
}

TEST(Torch, FlickersGentlyAndTheSameEachTime) {
    Simulation first(LevelBuilder().floor(20.0).level()), second(LevelBuilder().floor(20.0).level());
    StepInput input;
    input.torch = true;
    double before = 1.0, least = 9.0, most = 0.0;
    for (int i = 0; i < 600; ++i) {
        first.step(input);
        second.step(input);
        input.torch = false;
        const double brightness = first.state().torch.brightness;
        ASSERT_EQ(brightness, second.state().torch.brightness);
        ASSERT_TRUE(i == 0 || std::abs(brightness - before) < 0.05) << "step " << i;
        before = brightness;
        least = std::min(least, brightness);
        most = std::max(most, brightness);
    }
    EXPECT_GT(least, 0.8);
    EXPECT_LT(most, 1.2);
    EXPECT_GT(most - least, 0.1);
    game::PlayState other = first.state();
    other.torch.is_lit = false;
    EXPECT_NE(compute_hash(other), compute_hash(first.state()));
}

TEST(Torch, StaysOnThisSideOfAWall) {
    Simulation simulation(LevelBuilder().floor(20.0).wall_ahead(-1.0).level());
    StepInput input = tarn::test::go_ahead(true);
    input.torch = true;
    for (int i = 0; i < 120; ++i) {
        simulation.step(input);
        input.torch = false;
        ASSERT_GT(simulation.state().torch.position.z, -1.0) << "step " << i;
    }
    EXPECT_LT(simulation.state().player.feet.z, -0.6);
}

TEST(LanternCourt, CanBeWalkedInAndHasDeadLanterns) {
    const game::Level level =
        game::make_level(game::Scene::load(TARN_BUILD_DIR "/content/lantern_court.glb"));
    EXPECT_GT(level.triangles.size(), 50000u);
    Simulation simulation(level);
    EXPECT_GE(simulation.state().dead_count, 5);
    EXPECT_LE(simulation.state().dead_count, 30);
    run_steps(simulation, 30);
    EXPECT_TRUE(simulation.state().player.is_on_ground);
    EXPECT_NEAR(simulation.state().player.feet.y, 0.0, 0.1);
    RandomPlayer player(5);
    for (int i = 0; i < 3000; ++i) {
        simulation.step(player.next());
        ASSERT_TRUE(is_finite(simulation.state()));
        ASSERT_GT(simulation.state().player.feet.y, -0.3) << "step " << i;
    }
}

}  // namespace
