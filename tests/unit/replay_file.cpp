// Files of replays: what is written is read again, and what is broken is named.
#include <gtest/gtest.h>

#include <fstream>
#include <thread>

#include "game/play/replay_recorder.h"
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
    replay.fireflies = 60;
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
    expect_error("", "line 1: the file is cut off before its first step");
    expect_error("hello\n", "line 1: this is no replay");
    expect_error(with("replay 4", "replay 3"), "line 1: its version is 3, this program reads 4");
    expect_error(with("size 96", "size 0"), "line 4: the width is '0'");
    expect_error(with("seed 4", "seed x4"), "line 5: the seed is 'x4");
    expect_error(with("level fedc", "level FEDC"), "line 3: the level's hash is 'FEDC");
    expect_error(with("fireflies 60", "fireflies 1001"), "line 6: the number of fireflies is '1001'");
    expect_error(with("fireflies 60\n", ""), "the line 'fireflies' is missing");
    expect_error(with("seed", "sead"), "line 5: 'sead' begins no line");
    const std::string seedless = with("seed 4000000000\n", "");
    expect_error(seedless, "line 8: the line 'seed' is missing");
    expect_error(seedless.substr(0, seedless.size() - 20), "line 8: the line 'seed' is missing");
    expect_error(with("set scale 0.5", "set scale"), "line 7: the setting's value is missing");
    expect_error(with("step ", "step 7 101 "), "right is '101'");
    expect_error(with("step ", "step 1 0 0 q 0 0 0\nstep "), "line 9: 'q' is no key");
    expect_error(with("step ", "step 99999999999 0 0 - 0 0 0\nstep "), "the count is '99999999999'");
    expect_error(with("end 500", "end 501"), "it ends after 501 steps, there are 500");
    expect_error(good + "step 1 0 0 - 0 0 0\n", "more after the end");
}

// What a program leaves that is killed at any moment: all lines that are whole count, and no half line does.
TEST_F(ReplayFile, CutOffAtAnyByteItKeepsAllWholeSteps) {
    Replay replay = make_replay();
    replay.steps.resize(60);
    save_replay(folder_.file("good.replay"), replay);
    const std::string good = tarn::test::read_text(folder_.file("good.replay"));
    const std::size_t head = game::describe_head(replay).size();
    std::size_t most = 0;
    for (std::size_t size = 0; size < good.size(); ++size) {
        const std::string text = good.substr(0, size);
        const std::string error = error_of(text);
        if (text.find('\n', head) == std::string::npos) {
            ASSERT_NE(error.find("a.replay: line"), std::string::npos)
                << "after " << size << " bytes: " << error;
            ASSERT_EQ(error.find('\n'), std::string::npos) << error;
            continue;
        }
        ASSERT_EQ(error, "") << "after " << size << " bytes";
        const Replay cut = load_replay(folder_.file("a.replay"));
        ASSERT_FALSE(cut.is_complete) << "after " << size << " bytes";
        ASSERT_GE(cut.steps.size(), most);
        most = cut.steps.size();
        ASSERT_TRUE(std::equal(cut.steps.begin(), cut.steps.end(), replay.steps.begin())) << size << " bytes";
        const auto lines = std::count(text.begin() + std::ptrdiff_t(head), text.end(), '\n');
        ASSERT_GE(cut.steps.size(), std::size_t(lines));
    }
    EXPECT_EQ(most, replay.steps.size());
}

TEST_F(ReplayFile, WhatIsFlushedIsThereWhateverHappensNext) {
    const Replay replay = make_replay();
    game::ReplayRecorder recorder(folder_.file("a.replay"), replay);
    for (std::size_t i = 0; i < replay.steps.size(); ++i) {
        recorder.add(replay.steps[i]);
        if (i % 97 != 96) continue;
        recorder.flush();
        EXPECT_EQ(load_replay(folder_.file("a.replay")).steps.size(), i + 1);
    }
    recorder.add({});
    std::this_thread::sleep_for(std::chrono::milliseconds(1010));
    recorder.flush_when_due();
    Replay read = load_replay(folder_.file("a.replay"));
    EXPECT_EQ(read.steps.size(), replay.steps.size() + 1);
    EXPECT_FALSE(read.is_complete);
    recorder.end(replay.state_hash);
    read = load_replay(folder_.file("a.replay"));
    EXPECT_TRUE(read.is_complete);
    EXPECT_EQ(read.state_hash, replay.state_hash);
}

TEST_F(ReplayFile, WhatCannotBeReadOrWrittenIsNamed) {
    EXPECT_THROW(load_replay(folder_.file("gone")), game::Error);
    EXPECT_THROW(load_replay(folder_.path()), game::Error);
    EXPECT_THROW(save_replay(folder_.file("no/such/folder"), make_replay()), game::Error);
    // A full disk is noticed when the file is started.
    EXPECT_THROW(game::ReplayRecorder("/dev/full", make_replay()), game::Error);
}

}  // namespace
