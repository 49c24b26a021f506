// tarn-sandbox --replay --headless: the same pictures on every run, and one line for what is broken.
#include <gtest/gtest.h>

#include <fstream>

#include "game/play/replay_recorder.h"
#include "game/play/simulation.h"
#include "support/play_guide.h"
#include "support/play_levels.h"
#include "support/process.h"

namespace {

using game::Replay;
using game::Simulation;
using tarn::test::Guide;
using tarn::test::ProcessResult;
using tarn::test::read_text;
using tarn::test::run_process;
using tarn::test::TemporaryFolder;

const std::string COURT = TARN_BUILD_DIR "/content/lantern_court.glb";
constexpr int STEPS = 96;
constexpr int EVERY = 8;

Replay make_head(const game::Level& level) {
    Replay replay;
    replay.scene = COURT;
    replay.level_hash = compute_hash(level);
    replay.fireflies = level.fireflies;
    replay.width_px = 96;
    replay.height_px = 54;
    const game::Settings settings = game::Settings::preset("clean");
    for (const game::SettingInfo& row : game::Settings::list())
        replay.settings.emplace_back(row.name, settings.get(row.name));
    return replay;
}

// Walks, turns and, if wanted, throws.
Replay record_walk(int steps, bool throws) {
    const game::Level level = game::make_level(game::Scene::load(COURT));
    Simulation simulation(level);
    Replay replay = make_head(level);
    for (int i = 0; i < steps; ++i) {
        game::StepInput input = tarn::test::go_ahead(i > 40);
        input.look_right = i % 3;
        input.throw_ball = throws && i % 12 == 5;
        replay.steps.push_back(input);
        simulation.step(input);
    }
    replay.state_hash = compute_hash(simulation.state());
    return replay;
}

// Climbs the court's stair, throws from the gallery by the light of a torch, lights a
// lantern.
Replay record_climb() {
    const game::Level level = game::make_level(game::Scene::load(COURT));
    Simulation simulation(level);
    Guide guide(simulation);
    EXPECT_TRUE(climb_to_the_gallery(guide));
    game::StepInput hands;
    hands.torch = hands.throw_ball = true;
    guide.step(hands);
    guide.look_at({-17.0, 6.372, -1.5});
    game::StepInput use;
    use.use = true;
    guide.step(use);
    EXPECT_GT(simulation.state().player.feet.y, 4.0);
    EXPECT_EQ(simulation.state().relit_count, 1);
    Replay replay = make_head(level);
    replay.steps = guide.steps();
    replay.state_hash = compute_hash(simulation.state());
    return replay;
}

class SandboxReplay : public testing::Test {
  protected:
    static void SetUpTestSuite() { replay_ = std::make_unique<Replay>(record_walk(STEPS, true)); }
    static void TearDownTestSuite() { replay_.reset(); }

    ProcessResult play(const std::string& out) {
        return run_process({TARN_BUILD_DIR "/tarn-sandbox", "--replay", folder_.file("a.replay"),
                            "--headless", "--every", std::to_string(EVERY), "--out", folder_.file(out)});
    }
    std::vector<std::string> read_frames(const std::string& out) {
        std::vector<std::string> frames;
        for (int i = 0;; ++i) {
            const std::string file = folder_.file(fmt::format("{}/frame_{:06}.png", out, i));
            if (!std::filesystem::exists(file)) return frames;
            frames.push_back(read_text(file));
        }
    }
    void expect_error(const std::string& part) {
        const ProcessResult result = play("error");
        EXPECT_EQ(result.status, 1);
        EXPECT_EQ(result.error_lines(), 1) << result.err;
        EXPECT_NE(result.err.find("a.replay: "), std::string::npos) << result.err;
        EXPECT_NE(result.err.find(part), std::string::npos) << result.err;
    }

    static inline std::unique_ptr<Replay> replay_;
    TemporaryFolder folder_;
};

TEST_F(SandboxReplay, TwoRunsShowTheSamePictures) {
    game::save_replay(folder_.file("a.replay"), *replay_);
    for (const char* out : {"first", "second"}) {
        const ProcessResult result = play(out);
        ASSERT_EQ(result.status, 0) << result.err;
    }
    const std::vector<std::string> first = read_frames("first");
    ASSERT_EQ(first.size(), std::size_t(STEPS / EVERY + 1));
    EXPECT_EQ(first, read_frames("second"));
    for (std::size_t i = 1; i < first.size(); ++i) EXPECT_NE(first[i], first[i - 1]);
    EXPECT_TRUE(first[0].starts_with("\x89PNG"));

    // Other inputs, other pictures: what is compared is what was played.
    Replay other = *replay_;
    other.steps[2].look_right += 40;
    game::save_replay(folder_.file("a.replay"), other);
    expect_error("the play ended in the state");
    EXPECT_EQ(read_frames("error")[0], first[0]);
    EXPECT_NE(read_frames("error")[1], first[1]);
}

TEST_F(SandboxReplay, WhatIsThrownIsSeen) {
    for (const bool throws : {false, true}) {
        game::save_replay(folder_.file("a.replay"), record_walk(2 * EVERY, throws));
        const ProcessResult result = play(throws ? "throwing" : "walking");
        ASSERT_EQ(result.status, 0) << result.err;
    }
    const std::vector<std::string> walking = read_frames("walking"), throwing = read_frames("throwing");
    ASSERT_EQ(walking.size(), 3u);
    ASSERT_EQ(throwing.size(), 3u);
    EXPECT_EQ(walking[0], throwing[0]);
    EXPECT_NE(walking[1], throwing[1]);
    EXPECT_NE(walking[2], throwing[2]);
}

TEST_F(SandboxReplay, ATorchLightsWhatIsNear) {
    Replay dark = record_walk(EVERY, false), lit = dark;
    dark.is_complete = lit.is_complete = false;  // the state has the torch in it
    lit.steps[0].torch = true;
    for (const bool torch : {false, true}) {
        game::save_replay(folder_.file("a.replay"), torch ? lit : dark);
        const ProcessResult result = play(torch ? "lit" : "dark");
        ASSERT_EQ(result.status, 0) << result.err;
    }
    ASSERT_EQ(read_frames("lit").size(), 2u);
    EXPECT_EQ(read_frames("lit")[0], read_frames("dark")[0]);
    EXPECT_NE(read_frames("lit")[1], read_frames("dark")[1]);
}

TEST_F(SandboxReplay, FirefliesAreSeen) {
    Replay none = record_walk(2 * EVERY, false), many = none;
    none.is_complete = many.is_complete = false;  // the state has the fireflies in it
    none.fireflies = 0;
    many.fireflies = 1000;
    for (const bool flies : {false, true}) {
        game::save_replay(folder_.file("a.replay"), flies ? many : none);
        const ProcessResult result = play(flies ? "many" : "none");
        ASSERT_EQ(result.status, 0) << result.err;
    }
    ASSERT_EQ(read_frames("many").size(), 3u);
    for (std::size_t i = 0; i < 3; ++i) EXPECT_NE(read_frames("many")[i], read_frames("none")[i]);
}

// The program itself holds the state at the end against the recorded one.
TEST_F(SandboxReplay, ALongWalkUpTheStairEndsTheSameInTheProgramWithAndWithoutAWindow) {
    game::save_replay(folder_.file("a.replay"), record_climb());
    const std::vector<std::string> program = {
        TARN_BUILD_DIR "/tarn-sandbox", "--replay", folder_.file("a.replay"), "--every", "100", "--out"};
    std::vector<std::string> headless = program;
    headless.insert(headless.end(), {folder_.file("headless"), "--headless", "--threads", "1"});
    ProcessResult result = run_process(headless);
    EXPECT_EQ(result.status, 0) << result.err;
    EXPECT_EQ(result.err, "");
    if (std::string(TARN_WITH_DISPLAY).empty()) GTEST_SKIP() << "no Xvfb";
    std::vector<std::string> windowed = program;
    windowed.insert(windowed.begin(), TARN_WITH_DISPLAY);
    windowed.insert(windowed.end(), {folder_.file("windowed")});
    result = run_process(windowed);
    EXPECT_EQ(result.status, 0) << result.err;
    ASSERT_GT(read_frames("headless").size(), 2u);
    EXPECT_EQ(read_frames("headless"), read_frames("windowed"));
}

TEST_F(SandboxReplay, WhatIsCutOffIsPlayedAsFarAsItGoes) {
    Replay replay = *replay_;
    replay.is_complete = false;
    replay.steps.resize(EVERY);
    game::save_replay(folder_.file("a.replay"), replay);
    const ProcessResult result = play("cut");
    EXPECT_EQ(result.status, 0) << result.err;
    EXPECT_EQ(result.error_lines(), 1) << result.err;
    EXPECT_NE(result.err.find("a.replay: cut off after 8 steps"), std::string::npos) << result.err;
    EXPECT_EQ(read_frames("cut").size(), 2u);
}

TEST_F(SandboxReplay, WhatIsBrokenIsNamedInOneLine) {
    Replay replay = *replay_;
    replay.level_hash ^= 1;
    game::save_replay(folder_.file("a.replay"), replay);
    expect_error("recorded in the level");
    replay = *replay_;
    replay.settings.emplace_back("colour", "red");
    game::save_replay(folder_.file("a.replay"), replay);
    expect_error("no setting 'colour'");
    std::ofstream(folder_.file("a.replay")) << "tarn-sandbox-replay 4\nscene x\n";
    expect_error("line 3: the file is cut off before its first step");
}

}  // namespace
