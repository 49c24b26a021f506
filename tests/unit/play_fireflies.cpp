// Fireflies: they stay in the open air that can be reached from the start, move and blink softly, and are the
// same in every run.
#include <gtest/gtest.h>
#include <tarn/scene.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "support/play_levels.h"

namespace {

using game::FireflyState;
using game::Level;
using game::Simulation;
using game::Vec3;
using tarn::test::LevelBuilder;
using tarn::test::run_steps;

constexpr double ROOM_HALF_M = 8.0, ROOM_HEIGHT_M = 6.0;
constexpr double VAULT_M = 3.0;  // around x = -4, z = -4, and as high

// A room with a closed vault in it that has air inside.
Level make_room(int fireflies) {
    LevelBuilder builder;
    builder.room(ROOM_HALF_M, ROOM_HEIGHT_M);
    const Vec3 a{-5.5, 0, -5.5}, b{-2.5, 0, -5.5}, c{-2.5, 0, -2.5}, d{-5.5, 0, -2.5};
    const auto raise = [&](const Vec3& p) { return Vec3{p.x, VAULT_M, p.z}; };
    builder.quad(a, b, raise(b), raise(a)).quad(b, c, raise(c), raise(b)).quad(c, d, raise(d), raise(c));
    builder.quad(d, a, raise(a), raise(d)).quad(raise(a), raise(b), raise(c), raise(d));
    Level level = builder.level();
    level.fireflies = fireflies;
    return level;
}

bool is_in_vault(const Vec3& p) {
    return p.x > -5.5 && p.x < -2.5 && p.z > -5.5 && p.z < -2.5 && p.y < VAULT_M;
}

double distance(const Vec3& a, const Vec3& b) {
    return std::hypot(a.x - b.x, a.y - b.y, a.z - b.z);
}

// Whether the way from `a` to `b` passes a triangle: by the signs of volumes.
bool passes(const Vec3& a, const Vec3& b, const std::array<float, 9>& t) {
    const Vec3 p{t[0], t[1], t[2]}, q{t[3], t[4], t[5]}, r{t[6], t[7], t[8]};
    const auto volume = [](const Vec3& o, const Vec3& u, const Vec3& v, const Vec3& w) {
        const Vec3 x{u.x - o.x, u.y - o.y, u.z - o.z}, y{v.x - o.x, v.y - o.y, v.z - o.z},
            z{w.x - o.x, w.y - o.y, w.z - o.z};
        return x.x * (y.y * z.z - y.z * z.y) + x.y * (y.z * z.x - y.x * z.z) + x.z * (y.x * z.y - y.y * z.x);
    };
    if ((volume(a, p, q, r) > 0.0) == (volume(b, p, q, r) > 0.0)) return false;
    const bool side = volume(a, b, p, q) > 0.0;
    return side == (volume(a, b, q, r) > 0.0) && side == (volume(a, b, r, p) > 0.0);
}

TEST(Fireflies, StayInTheRoomAndOutOfWhatIsClosed) {
    Simulation simulation(make_room(300));
    ASSERT_EQ(simulation.state().fireflies.size(), 300u);
    for (int step = 0; step < 3000; ++step) {
        simulation.step({});
        for (const FireflyState& firefly : simulation.state().fireflies) {
            const Vec3& p = firefly.position;
            ASSERT_LT(std::max(std::abs(p.x), std::abs(p.z)), ROOM_HALF_M) << "step " << step;
            ASSERT_GT(p.y, 0.0);
            ASSERT_LT(p.y, ROOM_HEIGHT_M);
            ASSERT_FALSE(is_in_vault(p)) << p.x << ", " << p.y << ", " << p.z << ", step " << step;
        }
    }
}

TEST(Fireflies, AreAllOverTheRoomAndNotHigh) {
    Simulation simulation(make_room(300));
    std::set<int> quarters;
    for (const FireflyState& firefly : simulation.state().fireflies) {
        quarters.insert(int(firefly.position.x > 0.0) + 2 * int(firefly.position.z > 0.0));
        EXPECT_LT(firefly.position.y, VAULT_M + 3.2);
    }
    EXPECT_EQ(quarters.size(), 4u);
}

// A floor in the air ends where nothing holds them: there they do not go.
TEST(Fireflies, StayWithinTheBoundsOfAnOpenLevel) {
    Level level = LevelBuilder().floor(5.0).level();
    level.fireflies = 200;
    Simulation simulation(level);
    ASSERT_EQ(simulation.state().fireflies.size(), 200u);
    for (int step = 0; step < 2000; ++step) {
        simulation.step({});
        for (const FireflyState& firefly : simulation.state().fireflies) {
            ASSERT_LT(std::max(std::abs(firefly.position.x), std::abs(firefly.position.z)), 5.0);
            ASSERT_GT(firefly.position.y, 0.0);
            ASSERT_LT(firefly.position.y, 3.2);
        }
    }
}

TEST(Fireflies, WanderAndBlinkSoftlyEachInItsOwnTime) {
    constexpr int STEPS = 8 * game::STEPS_PER_S;  // longer than the slowest of them blinks
    Simulation simulation(make_room(50));
    const std::vector<FireflyState> start = simulation.state().fireflies;
    std::vector<double> farthest(50, 0.0), dimmest(50, 1.0), brightest(50, 0.0);
    std::vector<FireflyState> before = start;
    for (int step = 0; step < STEPS; ++step) {
        simulation.step({});
        for (std::size_t i = 0; i < 50; ++i) {
            const FireflyState& now = simulation.state().fireflies[i];
            ASSERT_LT(distance(now.position, before[i].position), 0.02) << "faster than 1.2 m/s";
            ASSERT_LT(std::abs(now.brightness - before[i].brightness), 0.05);
            ASSERT_GT(now.brightness, 0.0);
            ASSERT_LE(now.brightness, 1.0);
            farthest[i] = std::max(farthest[i], distance(now.position, start[i].position));
            dimmest[i] = std::min(dimmest[i], now.brightness);
            brightest[i] = std::max(brightest[i], now.brightness);
        }
        before = simulation.state().fireflies;
    }
    std::set<double> brightnesses;
    for (std::size_t i = 0; i < 50; ++i) {
        EXPECT_GT(farthest[i], 0.1);
        EXPECT_LT(dimmest[i], 0.1);
        EXPECT_GT(brightest[i], 0.95);
        brightnesses.insert(before[i].brightness);
    }
    EXPECT_EQ(brightnesses.size(), 50u);
}

TEST(Fireflies, AreTheSameInEveryRunAndFewerAreTheFirstOfMore) {
    Simulation once(make_room(40)), again(make_room(40)), fewer(make_room(10));
    run_steps(once, 100, tarn::test::go_ahead());
    run_steps(again, 100, tarn::test::go_ahead());
    run_steps(fewer, 100, tarn::test::go_ahead());
    EXPECT_EQ(compute_hash(once.state()), compute_hash(again.state()));
    ASSERT_EQ(fewer.state().fireflies.size(), 10u);
    for (std::size_t i = 0; i < 10; ++i)
        EXPECT_EQ(distance(once.state().fireflies[i].position, fewer.state().fireflies[i].position), 0.0);
}

TEST(Fireflies, BelongToTheStateThatIsHashed) {
    Simulation simulation(make_room(3));
    game::PlayState state = simulation.state();
    state.fireflies[2].position.y += 1e-9;
    EXPECT_NE(compute_hash(state), compute_hash(simulation.state()));
    state = simulation.state();
    state.fireflies[2].brightness *= 0.5;
    EXPECT_NE(compute_hash(state), compute_hash(simulation.state()));
}

TEST(Fireflies, WithoutRoomThereAreNoneAndThereAreNeverTooMany) {
    Level narrow = LevelBuilder().room(0.6, 2.2).level();
    narrow.fireflies = 10;
    EXPECT_TRUE(Simulation(narrow).state().fireflies.empty());
    EXPECT_TRUE(Simulation(make_room(0)).state().fireflies.empty());
    EXPECT_EQ(Simulation(make_room(5000)).state().fireflies.size(), std::size_t(game::FIREFLY_LIMIT));
    Level empty;
    empty.fireflies = 5;
    EXPECT_EQ(Simulation(empty).state().fireflies.size(), 5u);
}

TEST(Fireflies, InTheCourtThereAreSixtyAndNoneFliesThroughAWall) {
    const Level level = game::make_level(game::Scene::load(TARN_BUILD_DIR "/content/lantern_court.glb"));
    Simulation simulation(level);
    ASSERT_EQ(simulation.state().fireflies.size(), 60u);
    const auto local = [&](const Vec3& p) {
        return Vec3{p.x - level.origin.x, p.y - level.origin.y, p.z - level.origin.z};
    };
    for (int look = 0; look < 4; ++look) {
        const std::vector<FireflyState> before = simulation.state().fireflies;
        run_steps(simulation, 4 * game::STEPS_PER_S);
        for (std::size_t i = 0; i < 60; ++i) {
            const Vec3 from = local(before[i].position), to = local(simulation.state().fireflies[i].position);
            for (const std::array<float, 9>& triangle : level.triangles)
                ASSERT_FALSE(passes(from, to, triangle)) << "firefly " << i << ", look " << look;
        }
    }
    EXPECT_EQ(game::make_level(game::Scene::load(TARN_BUILD_DIR "/content/cornell.glb")).fireflies, 0);
}

}  // namespace
