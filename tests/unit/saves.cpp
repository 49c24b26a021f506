// Where saves lie, and what becomes of those that cannot be taken.
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "game/sandbox/saves.h"
#include "game/user_folders.h"
#include "support/play_levels.h"
#include "support/process.h"

namespace {

using game::SaveKind;
using game::Saves;
using game::Stage;
using tarn::test::read_text;

Stage make_stage(const std::string& scene) {
    return Stage(game::Scene::load(TARN_BUILD_DIR "/content/" + scene + ".glb"), 3);
}

class SavesOfALevel : public testing::Test {
  protected:
    std::string error_of(const Saves& saves, SaveKind kind, Stage& stage) {
        try {
            saves.load(kind, stage);
        } catch (const game::Error& error) {
            return error.what();
        }
        return "";
    }

    tarn::test::TemporaryFolder folder_;
    Stage stage_ = make_stage("cornell");
    Saves saves_{folder_.path() / "new" / "folder", "rooms/cornell.glb", stage_.level_hash()};
};

TEST_F(SavesOfALevel, BringAStageBack) {
    EXPECT_FALSE(saves_.load(SaveKind::ASKED_FOR, stage_));
    for (int i = 0; i < 30; ++i) stage_.step(tarn::test::go_ahead());
    const std::uint64_t saved = compute_hash(stage_.state());
    saves_.write(SaveKind::ASKED_FOR, stage_);
    for (int i = 0; i < 30; ++i) stage_.step({});
    ASSERT_NE(compute_hash(stage_.state()), saved);
    EXPECT_FALSE(saves_.load(SaveKind::AUTOMATIC, stage_));
    EXPECT_TRUE(saves_.load(SaveKind::ASKED_FOR, stage_));
    EXPECT_EQ(compute_hash(stage_.state()), saved);
    const std::string name = saves_.file(SaveKind::AUTOMATIC).filename().string();
    EXPECT_EQ(name, fmt::format("cornell-{:016x}.autosave", stage_.level_hash()));
}

TEST_F(SavesOfALevel, WhatIsDamagedIsKeptAsideAndTheStageStays) {
    const std::uint64_t before = compute_hash(stage_.state());
    const std::filesystem::path file = saves_.file(SaveKind::AUTOMATIC);
    for (const char* aside : {".damaged", ".damaged.2"}) {
        game::write_whole(file, "tarn-sandbox-save 1\nnonsense");
        const std::string error = error_of(saves_, SaveKind::AUTOMATIC, stage_);
        EXPECT_TRUE(error.starts_with(file.string() + ": ")) << error;
        EXPECT_TRUE(error.ends_with("; kept as " + file.filename().string() + aside)) << error;
        EXPECT_EQ(error.find('\n'), std::string::npos);
        EXPECT_FALSE(std::filesystem::exists(file));
        EXPECT_EQ(read_text(file.string() + aside), "tarn-sandbox-save 1\nnonsense");
    }
    EXPECT_EQ(compute_hash(stage_.state()), before);
}

TEST_F(SavesOfALevel, OneOfAnotherLevelIsRefusedWithBothNames) {
    Stage other = make_stage("corner");
    const Saves others(folder_.path(), "corner", other.level_hash());
    others.write(SaveKind::ASKED_FOR, other);
    std::filesystem::create_directories(saves_.file(SaveKind::ASKED_FOR).parent_path());
    std::filesystem::copy(others.file(SaveKind::ASKED_FOR), saves_.file(SaveKind::ASKED_FOR));
    const std::string error = error_of(saves_, SaveKind::ASKED_FOR, stage_);
    EXPECT_NE(error.find("saved in 'corner'"), std::string::npos) << error;
    EXPECT_NE(error.find("this is 'rooms/cornell.glb'"), std::string::npos) << error;
    EXPECT_TRUE(std::filesystem::exists(saves_.file(SaveKind::ASKED_FOR).string() + ".damaged"));
}

TEST_F(SavesOfALevel, WhatCannotBeWrittenIsNamedAndLeavesWhatWasThere) {
    saves_.write(SaveKind::ASKED_FOR, stage_);
    const std::filesystem::path file = saves_.file(SaveKind::ASKED_FOR);
    const std::string good = read_text(file);
    std::filesystem::create_directory(file.string() + ".part");
    EXPECT_THROW(saves_.write(SaveKind::ASKED_FOR, stage_), game::Error);
    EXPECT_EQ(read_text(file), good);
    std::ofstream(folder_.file("plain")) << "a file";
    EXPECT_THROW(Saves(folder_.file("plain"), "x", 1).write(SaveKind::ASKED_FOR, stage_), game::Error);
}

TEST(UserFolders, FollowTheEnvironment) {
    setenv("XDG_DATA_HOME", "/data", 1);
    setenv("HOME", "/home/somebody", 1);
    EXPECT_EQ(game::find_data_folder(), "/data/tarn");
    setenv("XDG_DATA_HOME", "relative", 1);
    EXPECT_EQ(game::find_data_folder(), "/home/somebody/.local/share/tarn");
    unsetenv("XDG_DATA_HOME");
    EXPECT_EQ(game::find_data_folder(), "/home/somebody/.local/share/tarn");
    unsetenv("HOME");
    EXPECT_THROW(game::find_data_folder(), game::Error);
}

}  // namespace
