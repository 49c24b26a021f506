// Files of replays: what is written is read again, and what is broken is named.
#include <gtest/gtest.h>

#include <fstream>

#include "game/play/replay_file.h"
#include "game/tarn_names.h"
#include "support/play_levels.h"
#include "support/process.h"

namespace {

using game::load_replay;
using game::Replay;
using game::save_replay;

Replay make_replay() {
    Replay replay;
    replay.scene = "a scene with blanks.glb";
    replay.level_hash = 0xfedcba9876543210u;
    replay.width_px = 96;
    replay.height_px = 54;
    replay.seed = 4000000000u;
    replay.settings = {{"scale", "0.5"}, {"direct", "restir"}};
    tarn::test::RandomPlayer player(1);
    for (int i = 0; i < 500; ++i) replay.steps.push_back(player.next());
    replay.steps[7].restart = true;
    replay.state_hash = 17;
    return replay;
}

class ReplayFile : public testing::Test {
  protected:
    std::string error_of(const std::string& text) {
        std::ofstream(folder_.file("a.replay")) << text;
        try {
            load_replay(folder_.file("a.replay"));
        } catch (const game::Error& error) {
            return error.what();
        }
        return "";
    }
    void expect_error(const std::string& text, const std::string& part) {
        const std::string error = error_of(text);
        EXPECT_NE(error.find("a.replay: line"), std::string::npos) << error;
        EXPECT_NE(error.find(part), std::string::npos) << error;
        EXPECT_EQ(error.find('\n'), std::string::npos) << error;
    }

    tarn::test::TemporaryFolder folder_;
};

TEST_F(ReplayFile, IsReadAsItWasWritten) {
    const Replay replay = make_replay();
    save_replay(folder_.file("a.replay"), replay);
    EXPECT_EQ(load_replay(folder_.file("a.replay")), replay);
    EXPECT_FALSE(std::filesystem::exists(folder_.file("a.replay.part")));
    // Runs of the same input take one line.
    EXPECT_LT(std::filesystem::file_size(folder_.file("a.replay")), 500u * 20u);
}

TEST_F(ReplayFile, WhatIsBrokenIsNamed) {
    save_replay(folder_.file("good.replay"), make_replay());
    const std::string good = tarn::test::read_text(folder_.file("good.replay"));
    ASSERT_EQ(error_of(good), "");
    const auto with = [&](const std::string& from, const std::string& to) {
        std::string text = good;
        text.replace(text.find(from), from.size(), to);
        return text;
    };
    expect_error("", "line 1: the line 'end' is missing");
    expect_error("hello\n", "line 1: this is no replay");
    expect_error(with("replay 1", "replay 2"), "line 1: its version is 2, this program reads 1");
    expect_error(with("size 96", "size 0"), "line 4: the width is '0'");
    expect_error(with("seed 4", "seed x4"), "line 5: the seed is 'x4");
    expect_error(with("level fedc", "level FEDC"), "line 3: the level's hash is 'FEDC");
    expect_error(with("seed", "sead"), "line 5: 'sead' begins no line");
    expect_error(with("seed 4000000000\n", ""), "the line 'seed' is missing");
    expect_error(with("set scale 0.5", "set scale"), "line 6: the setting's value is missing");
    expect_error(with("step ", "step 7 9 "), "right is '9'");
    expect_error(with("step ", "step 1 0 0 q 0 0 0\nstep "), "line 8: 'q' is no key");
    expect_error(with("step ", "step 99999999999 0 0 - 0 0 0\nstep "), "the count is '99999999999'");
    expect_error(with("end 500", "end 501"), "it ends after 501 steps, there are 500");
    expect_error(good.substr(0, good.size() / 2), "");
    expect_error(good + "step 1 0 0 - 0 0 0\n", "more after the end");
}

TEST_F(ReplayFile, WhatCannotBeReadOrWrittenIsNamed) {
    EXPECT_THROW(load_replay(folder_.file("gone")), game::Error);
    EXPECT_THROW(load_replay(folder_.path()), game::Error);
    EXPECT_THROW(save_replay(folder_.file("no/such/folder"), make_replay()), game::Error);
    // What was there stays where the new one cannot be written.
    std::filesystem::create_directory(folder_.file("taken"));
    std::ofstream(folder_.file("taken/inside")) << "kept";
    EXPECT_THROW(save_replay(folder_.file("taken"), make_replay()), game::Error);
    EXPECT_EQ(tarn::test::read_text(folder_.file("taken/inside")), "kept");
    EXPECT_FALSE(std::filesystem::exists(folder_.file("taken.part")));
}

}  // namespace
