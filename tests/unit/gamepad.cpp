// A gamepad: what its sticks mean, and what its buttons do in the sandbox.
#include "game/gamepad.h"

#include <gtest/gtest.h>

#include <cmath>

#include "game/sandbox/controls.h"

namespace game {
namespace {

double length_of(const Vec2& v) {
    return std::hypot(v.x, v.y);
}

PadState make_pad() {
    PadState pad;
    pad.is_there = true;
    return pad;
}

TEST(ShapeStick, RestsInTheMiddleAndIsFullBeforeTheRim) {
    EXPECT_EQ(length_of(shape_stick({0.0, 0.0})), 0.0);
    EXPECT_EQ(length_of(shape_stick({0.12, -0.12})), 0.0);  // round, not a square: 0.17 from the middle
    EXPECT_GT(length_of(shape_stick({0.14, -0.14})), 0.0);
    EXPECT_NEAR(shape_stick({1.0, 0.0}).x, 1.0, 1e-12);
    EXPECT_NEAR(shape_stick({0.0, -0.96}).y, -1.0, 1e-12);
    EXPECT_NEAR(length_of(shape_stick({1.0, 1.0})), 1.0, 1e-12);  // square pads reach their corners
    EXPECT_EQ(length_of(shape_stick({std::nan(""), 0.5})), 0.0);
}

TEST(ShapeStick, GrowsWithoutJumpsSlowlyAtFirstAndKeepsItsDirection) {
    double before = 0.0;
    for (int i = 0; i <= 1000; ++i) {
        const Vec2 raw{0.6 * i / 1000.0, -0.8 * i / 1000.0};
        const Vec2 shaped = shape_stick(raw);
        const double now = length_of(shaped);
        ASSERT_GE(now, before - 1e-12);
        ASSERT_LT(now - before, 0.005);
        ASSERT_NEAR(shaped.x, -0.75 * shaped.y, 1e-12);
        before = now;
    }
    EXPECT_LT(length_of(shape_stick({0.565, 0.0})), 0.4);  // half way
    EXPECT_GT(length_of(shape_stick({0.565, 0.0})), 0.2);
}

TEST(PadInput, SticksWalkWithTheirShareOfTheSpeed) {
    StepInput play;
    PadState pad = make_pad();
    add_pad(pad, make_pad(), play);
    EXPECT_EQ(play, StepInput());
    pad.left_stick = {0.0, -1.0};
    add_pad(pad, make_pad(), play);
    EXPECT_EQ(play.forward, FULL_SPEED);
    EXPECT_EQ(play.right, 0);
    play = {};
    pad.left_stick = {-0.5, 0.0};
    add_pad(pad, make_pad(), play);
    EXPECT_LT(play.right, -10);
    EXPECT_GT(play.right, -60);
    // Keys go first.
    play.right = FULL_SPEED;
    add_pad(pad, make_pad(), play);
    EXPECT_EQ(play.right, FULL_SPEED);
}

TEST(PadInput, ButtonsActOnceAndBAndTheLeftTriggerWhileHeld) {
    PadState pad = make_pad();
    pad.a = pad.b = pad.x = true;
    pad.left_trigger = pad.right_trigger = 1.0;
    StepInput first, second;
    add_pad(pad, make_pad(), first);
    EXPECT_TRUE(first.jump && first.crouch && first.use && first.throw_ball && first.run);
    add_pad(pad, pad, second);
    EXPECT_TRUE(second.crouch && second.run);
    EXPECT_FALSE(second.jump || second.use || second.throw_ball);
    // A trigger that is hardly touched throws nothing.
    pad.right_trigger = 0.3;
    StepInput third;
    add_pad(pad, make_pad(), third);
    EXPECT_FALSE(third.throw_ball);
}

TEST(PadInput, PluggingInAndOutDoesNothing) {
    PadState pad = make_pad();
    pad.a = pad.x = true;
    pad.right_trigger = 1.0;
    StepInput play;
    add_pad(pad, PadState(), play);  // with buttons held
    EXPECT_EQ(play, StepInput());
    add_pad(PadState(), pad, play);
    EXPECT_EQ(play, StepInput());
}

}  // namespace
}  // namespace game
