// Holding the time of a frame: which settings a ladder cuts, and how the governor climbs on it. Oracle: a
// machine whose frames take a known time on each rung.
#include "game/sandbox/governor.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

namespace game {
namespace {

// ---- The ladder

TEST(Ladder, EachRungCutsOneSettingAndNeverRaisesOne) {
    Settings chosen = Settings::preset("clean");
    const Ladder ladder(chosen);
    ASSERT_GT(ladder.size(), 5);
    EXPECT_EQ(ladder.sentence(0), "as chosen");
    for (int rung = 1; rung < ladder.size(); ++rung) {
        std::string changed;
        for (const SettingInfo& row : Settings::list()) {
            if (ladder.settings(rung).get(row.name) != ladder.settings(rung - 1).get(row.name))
                changed += row.name + " " + ladder.settings(rung).get(row.name);
        }
        EXPECT_EQ(changed, ladder.sentence(rung));
    }
    EXPECT_LE(ladder.settings(ladder.size() - 1).number("scale"), 0.25);
}

TEST(Ladder, WhatIsCheaperAlreadyHasNoRung) {
    Settings chosen = Settings::preset("clean");
    chosen.set("scale", "0.4");
    chosen.set("candidates", "4");
    chosen.set("indirect", "off");
    const Ladder ladder(chosen);
    ASSERT_EQ(ladder.size(), 3);
    EXPECT_EQ(ladder.sentence(1), "scale 0.33");
    EXPECT_EQ(ladder.sentence(2), "scale 0.25");
}

// ---- The governor

constexpr int RUNGS = 8;
constexpr double TARGET_MS = 33.0;

// Of so many frames: the rung of each, where a frame takes what `cost` says of its number and rung.
std::vector<int> run(Governor& governor, int frames, const std::function<double(int frame, int rung)>& cost,
                     double target_ms = TARGET_MS) {
    std::vector<int> rungs;
    for (int frame = 0; frame < frames; ++frame)
        rungs.push_back(governor.follow(cost(frame, governor.rung()), target_ms, RUNGS));
    return rungs;
}

// Each rung takes a fifth off.
double geometric(double first_ms, int rung) {
    return first_ms * std::pow(0.8, rung);
}

int count_changes(const std::vector<int>& rungs, std::size_t from) {
    int changes = 0;
    for (std::size_t i = from + 1; i < rungs.size(); ++i) changes += rungs[i] != rungs[i - 1] ? 1 : 0;
    return changes;
}

TEST(Governor, GoesDownUntilFramesFitAndStays) {
    for (const double first_ms : {20.0, 40.0, 60.0, 100.0, 150.0}) {
        Governor governor;
        const std::vector<int> rungs =
            run(governor, 2000, [&](int, int rung) { return geometric(first_ms, rung); });
        EXPECT_LE(geometric(first_ms, rungs.back()), 1.1 * TARGET_MS) << first_ms;
        EXPECT_GT(geometric(first_ms, rungs.back() - 1), 0.7 * TARGET_MS)
            << "lower than it must, " << first_ms;
        EXPECT_EQ(count_changes(rungs, 400), 0) << first_ms;
    }
}

TEST(Governor, ReachesTheLowestRungSoonWhereNothingHelps) {
    Governor governor;
    const std::vector<int> rungs = run(governor, 70, [](int, int) { return 400.0; });
    EXPECT_EQ(rungs.back(), RUNGS - 1);
}

TEST(Governor, ClimbsAgainWhenThereIsTime) {
    Governor governor;
    run(governor, 200, [](int, int) { return 400.0; });
    ASSERT_EQ(governor.rung(), RUNGS - 1);
    run(governor, 600, [](int, int rung) { return geometric(20.0, rung); });
    EXPECT_EQ(governor.rung(), 0);
}

TEST(Governor, SingleLongFramesChangeNothing) {
    Governor governor;
    const auto rungs = run(governor, 1000, [](int frame, int) { return frame % 4 == 0 ? 300.0 : 30.0; });
    EXPECT_EQ(count_changes(rungs, 0), 0);
}

// Two rungs, of which one is too slow and the next has time to spare: it tries seldom.
TEST(Governor, BetweenTwoRungsItDoesNotSwing) {
    Governor governor;
    const auto rungs = run(governor, 4000, [](int, int rung) { return rung < 3 ? 50.0 : 20.0; });
    EXPECT_LE(count_changes(rungs, 1000), 8);
    int slow = 0;
    for (std::size_t i = 1000; i < rungs.size(); ++i) slow += rungs[i] < 3 ? 1 : 0;
    EXPECT_LT(slow, 0.03 * 3000);
}

TEST(Governor, WithoutATargetAllIsAsChosen) {
    Governor governor;
    run(governor, 200, [](int, int) { return 400.0; });
    run(
        governor, 1, [](int, int) { return 400.0; }, 0.0);
    EXPECT_EQ(governor.rung(), 0);
}

TEST(Governor, FollowsALadderThatHasBecomeShorter) {
    Governor governor;
    run(governor, 200, [](int, int) { return 400.0; });
    EXPECT_EQ(governor.follow(400.0, TARGET_MS, 3), 2);
}

}  // namespace
}  // namespace game
