// Keys that the user may change: what the file says is what is bound, and what is wrong with it is named.
#include <gtest/gtest.h>
#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <fstream>

#include "game/sandbox/help.h"
#include "support/process.h"

#include <tarn/error.h>

namespace {

using game::Action;
using game::KeyMap;

class KeyFile : public testing::Test {
  protected:
    KeyMap load(const std::string& text) {
        std::ofstream(file_) << text;
        return game::load_keys(file_);
    }
    void expect_error(const std::string& text, const std::string& start, const std::string& part) {
        std::string error;
        try {
            load(text);
        } catch (const tarn::api::Error& thrown) {
            error = thrown.what();
        }
        EXPECT_TRUE(error.starts_with(file_ + ": " + start)) << error;
        EXPECT_NE(error.find(part), std::string::npos) << error;
        EXPECT_EQ(error.find('\n'), std::string::npos) << error;
    }

    tarn::test::TemporaryFolder folder_;
    std::string file_ = folder_.file("keys.ini");
};

TEST_F(KeyFile, OfTheDefaultsIsReadAsItWasWritten) {
    EXPECT_EQ(load(describe_keys(KeyMap())), KeyMap());
    EXPECT_EQ(load(""), KeyMap());
    KeyMap keys;
    keys.set_keys(Action::JUMP, {GLFW_KEY_7, GLFW_KEY_F12, GLFW_KEY_PAGE_UP});
    keys.set_keys(Action::SCREENSHOT, {});
    keys.set_keys(Action::USE, {GLFW_KEY_RIGHT_ALT});
    EXPECT_EQ(load(describe_keys(keys)), keys);
}

TEST_F(KeyFile, ChangesWhatItSaysAndNothingElse) {
    const KeyMap keys = load("# mine\n\n  forward = Up  W # both\ntorch=T\r\ncrouch =\n");
    EXPECT_EQ(keys.keys(Action::FORWARD), (std::vector<int>{GLFW_KEY_UP, GLFW_KEY_W}));
    EXPECT_EQ(keys.keys(Action::TORCH), std::vector<int>{GLFW_KEY_T});
    EXPECT_TRUE(keys.keys(Action::CROUCH).empty());
    EXPECT_EQ(keys.keys(Action::USE), std::vector<int>{GLFW_KEY_E});
    EXPECT_EQ(keys.describe(Action::FORWARD), "Up, W");
    EXPECT_EQ(keys.describe(Action::CROUCH), "no key");
}

TEST_F(KeyFile, WhatIsWrongIsNamedWithWhatIsAccepted) {
    expect_error("use = E\nfly = Q\n", "line 2: 'fly' is no action; there are forward, back", "screenshot");
    expect_error("use = Ctrl\n", "line 1: 'Ctrl' is no key; there are A to Z", "LeftControl");
    expect_error("use = e\n", "line 1: 'e' is no key", "A to Z");
    expect_error("use E\n", "line 1: a line is ACTION = KEY KEY", "");
    expect_error("use it = E\n", "line 1: a line is ACTION = KEY KEY", "");
    expect_error("use = Q\n\nuse = T\n", "line 3: 'use' is in line 1 already", "");
    expect_error("use = Q\ntorch = Q\n", "line 2: 'Q' is a key of 'use' already, in line 1", "");
    expect_error("jump = Q Q\n", "line 1: 'Q' is a key of 'jump' already", "");
    expect_error("torch = T\nsave = E\n", "line 2: 'E' is a key of 'use' already, which no line changes", "");
    EXPECT_THROW(game::load_keys(folder_.file("gone")), tarn::api::Error);
    EXPECT_THROW(game::load_keys(folder_.path()), tarn::api::Error);
}

// Two that change places.
TEST_F(KeyFile, TwoActionsMayExchangeTheirKeys) {
    const KeyMap keys = load("use = F\ntorch = E\n");
    EXPECT_EQ(keys.keys(Action::USE), std::vector<int>{GLFW_KEY_F});
    EXPECT_EQ(keys.keys(Action::TORCH), std::vector<int>{GLFW_KEY_E});
}

TEST(Help, ShowsEveryKeyAsItIsBound) {
    KeyMap keys;
    for (int i = 0; i < game::ACTION_COUNT; ++i) keys.set_keys(Action(i), {GLFW_KEY_A + i});
    const std::vector<game::HelpLine> lines = game::list_help(keys);
    for (int i = 0; i < game::ACTION_COUNT; ++i) {
        const std::string name(1, char('A' + i));
        const bool found = std::any_of(lines.begin(), lines.end(), [&](const game::HelpLine& line) {
            return (" " + line.keys + " ").find(" " + name + " ") != std::string::npos;
        });
        EXPECT_TRUE(found) << name;
    }
}

}  // namespace
