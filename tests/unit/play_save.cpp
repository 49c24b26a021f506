// Saves: play that is loaded is in the state that was saved and goes on with the same bits as if nothing had
// been saved; files that are damaged are found out, byte by byte.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <random>

#include "game/play/hash.h"
#include "game/play/save_file.h"
#include "support/play_levels.h"
#include "support/process.h"

namespace {

using game::compute_hash;
using game::Level;
using game::load_save;
using game::SaveFile;
using game::Simulation;
using game::StepInput;
using tarn::test::LevelBuilder;
using tarn::test::RandomPlayer;

constexpr int STEPS = 1500;  // two snapshots and a bit

// A room to climb in, with stacks of crates, lanterns and fireflies.
Level make_playground() {
    LevelBuilder builder;
    builder.room(8.0, 5.0)
        .wall_ahead(-3.0, 0.0, 0.5)
        .lantern({1.0, 2.2, 0.0}, true)
        .lantern({-1, 2, -2}, false);
    builder.quad({2, 0, 6}, {6, 0, 6}, {6, 2, 2}, {2, 2, 2}).quad({2, 2, 2}, {6, 2, 2}, {6, 2, 0}, {2, 2, 0});
    for (int i = 0; i < 9; ++i) builder.crate({-2.0 + 0.9 * (i % 3), 3.0, -1.2 + 0.3 * (i / 3)}, 0.1 * i);
    Level level = builder.level();
    level.fireflies = 5;
    return level;
}

std::vector<StepInput> make_inputs(std::uint32_t seed) {
    std::vector<StepInput> inputs(STEPS);
    RandomPlayer player(seed);
    for (StepInput& input : inputs) input = player.next();
    return inputs;
}

std::vector<std::uint64_t> play(const Level& level, const std::vector<StepInput>& inputs) {
    Simulation simulation(level);
    std::vector<std::uint64_t> hashes;
    for (const StepInput& input : inputs) {
        simulation.step(input);
        hashes.push_back(compute_hash(simulation.state()));
    }
    return hashes;
}

class PlaySave : public testing::Test {
  protected:
    SaveFile through_a_file(const game::SavedPlay& play) {
        const SaveFile save = {"a room", 0xfedcba9876543210u, play};
        write(describe_save(save));
        return load_save(file_);
    }
    void write(const std::string& text) { std::ofstream(file_, std::ios::binary) << text; }
    std::string error_of(const std::string& text) {
        write(text);
        try {
            load_save(file_);
        } catch (const game::Error& error) {
            return error.what();
        }
        return "";
    }
    // With a sum that is right.
    static std::string seal(std::string text) {
        text.resize(text.rfind("sum "));
        game::Hash hash;
        for (const char byte : text) hash.add(byte);
        return text + fmt::format("sum {:016x}\n", hash.value());
    }
    // Of play that has balls, crates out of place and a lit torch in it.
    static SaveFile make_save() {
        Simulation simulation(make_playground());
        StepInput torch;
        torch.torch = torch.throw_ball = true;
        simulation.step(torch);
        for (const StepInput& input : make_inputs(5)) {
            if (simulation.state().step < 700) simulation.step(input);
            if (simulation.state().step == 590 && !simulation.state().torch.is_lit) simulation.step(torch);
        }
        return {"a room", 7, simulation.save()};
    }

    tarn::test::TemporaryFolder folder_;
    std::string file_ = folder_.file("a.save");
};

TEST_F(PlaySave, WhatIsLoadedIsTheStateThatWasSavedAndGoesOnWithTheSameBits) {
    const Level level = make_playground();
    const std::vector<StepInput> inputs = make_inputs(1);
    const std::vector<std::uint64_t> without = play(level, inputs);
    Simulation saving(level), loading(level);
    for (int step = 0; step < STEPS; ++step) {
        saving.step(inputs[std::size_t(step)]);
        ASSERT_EQ(compute_hash(saving.state()), without[std::size_t(step)]) << "a save changed the play";
        if (step % 211 != 210) continue;
        // Into play that is somewhere else by now.
        loading.load(through_a_file(saving.save()).play);
        for (int next = step; next < std::min(step + 700, STEPS - 1); ++next) {
            ASSERT_EQ(compute_hash(loading.state()), without[std::size_t(next)])
                << "saved after step " << step << ", now after " << next;
            loading.step(inputs[std::size_t(next) + 1]);
        }
    }
}

TEST_F(PlaySave, AFileKeepsEveryNumber) {
    const SaveFile save = make_save();
    const auto& balls = save.play.snapshot.balls;
    ASSERT_GT(std::count_if(balls.begin(), balls.end(), [](const auto& ball) { return ball.is_alive; }), 2);
    ASSERT_TRUE(save.play.snapshot.torch);
    ASSERT_EQ(save.play.snapshot.step, 600u);
    ASSERT_EQ(save.play.since.size(), 100u);
    write(describe_save(save));
    EXPECT_EQ(load_save(file_), save);
}

TEST_F(PlaySave, ARestartIsSavedAsTheStart) {
    Simulation simulation(make_playground());
    const std::uint64_t start = compute_hash(simulation.state());
    for (int i = 0; i < 50; ++i) simulation.step(tarn::test::go_ahead());
    StepInput restart;
    restart.restart = true;
    simulation.step(restart);
    Simulation other(make_playground());
    for (int i = 0; i < 50; ++i) other.step(tarn::test::go_ahead());
    other.load(simulation.save());
    EXPECT_EQ(compute_hash(other.state()), start);
}

// Snapshots are taken while it stands.
TEST_F(PlaySave, WhatRestsIsNotTouchedBySnapshots) {
    Simulation simulation(LevelBuilder().floor(9.0).crate({2, 1, -3}, 0.3).crate({2, 3, -3}, 0.5).level());
    tarn::test::run_steps(simulation, 300);
    const std::vector<game::CrateState> before = simulation.state().crates;
    tarn::test::run_steps(simulation, 3 * game::SNAPSHOT_STEPS);
    for (std::size_t i = 0; i < 2; ++i) {
        const game::CrateState &a = before[i], &b = simulation.state().crates[i];
        EXPECT_TRUE(a.position.x == b.position.x && a.position.y == b.position.y &&
                    a.position.z == b.position.z);
        EXPECT_TRUE(a.rotation.y == b.rotation.y && a.rotation.w == b.rotation.w);
    }
}

double turn(const game::Rotation& a, const game::Rotation& b) {
    return std::abs(a.x - b.x) + std::abs(a.y - b.y) + std::abs(a.z - b.z) + std::abs(a.w - b.w);
}

TEST_F(PlaySave, WhoWalksAndJumpsGoesOnThroughASnapshot) {
    Simulation simulation(LevelBuilder().floor(60.0).level());
    double height = 0.0, z = 0.0, rise = 0.0;
    for (int step = 1; step <= game::SNAPSHOT_STEPS + 5; ++step) {
        StepInput input;
        if (step > game::SNAPSHOT_STEPS - 60) input = tarn::test::go_ahead();
        input.jump = step == game::SNAPSHOT_STEPS - 12;
        simulation.step(input);
        const game::Vec3& feet = simulation.state().player.feet;
        if (step > game::SNAPSHOT_STEPS - 5) {
            EXPECT_NEAR(z - feet.z, 0.05, 0.002) << "step " << step;
            EXPECT_NEAR(feet.y - height - rise, -9.81 / 3600.0, 0.001) << "step " << step;
        }
        rise = feet.y - height;
        height = feet.y;
        z = feet.z;
    }
    EXPECT_GT(height, 0.3);
}

TEST_F(PlaySave, BallsFlyAndRollOnThroughASnapshot) {
    Simulation simulation(LevelBuilder().floor(60.0).level());
    const auto is_alive = [](const game::BallState& ball) { return ball.is_alive; };
    std::vector<game::BallState> before;
    for (int step = 1; step <= game::SNAPSHOT_STEPS + 2; ++step) {
        StepInput input;
        input.look_right = step == 500 ? 300 : 0;
        input.throw_ball = step == 300 || step == game::SNAPSHOT_STEPS - 20;
        simulation.step(input);
        const std::vector<game::BallState>& balls = simulation.state().balls;
        for (std::size_t i = 0; i < 2 && step > game::SNAPSHOT_STEPS - 3; ++i) {
            const game::Vec3 &a = before[i].velocity, &b = balls[i].velocity;
            EXPECT_LT(std::hypot(a.x - b.x, a.z - b.z), 0.05) << "ball " << i << ", step " << step;
        }
        // The first rolls.
        if (step > game::SNAPSHOT_STEPS - 3) {
            EXPECT_GT(turn(before[0].rotation, balls[0].rotation), 0.05) << "step " << step;
        }
        before = balls;
    }
    EXPECT_GT(std::hypot(before[0].velocity.x, before[0].velocity.z), 1.0);
    StepInput another;
    another.throw_ball = true;
    simulation.step(another);
    EXPECT_EQ(std::count_if(simulation.state().balls.begin(), simulation.state().balls.end(), is_alive), 3);
}

TEST_F(PlaySave, DamagedAtAnyByteItIsReportedInOneLine) {
    const std::string good = describe_save(make_save());
    ASSERT_EQ(error_of(good), "");
    for (std::size_t place = 0; place < good.size(); place += 13) {
        for (const char flip : {'\x01', '\x40'}) {
            std::string text = good;
            text[place] = char(text[place] ^ flip);
            const std::string error = error_of(text);
            ASSERT_TRUE(error.starts_with(file_ + ": ")) << "byte " << place << ": " << error;
            ASSERT_EQ(error.find('\n'), std::string::npos) << error;
        }
        ASSERT_NE(error_of(good.substr(0, place)), "") << "cut off after " << place << " bytes";
    }
    EXPECT_NE(error_of(good + "\n").find("it is damaged"), std::string::npos);
    EXPECT_NE(error_of("hello\n").find("this is no save of tarn-sandbox"), std::string::npos);
    EXPECT_THROW(load_save(folder_.path()), game::Error);
}

TEST_F(PlaySave, WhatIsWrongThoughItsSumIsRightIsNamed) {
    const std::string good = describe_save(make_save());
    const auto expect_error = [&](const std::string& from, const std::string& to, const std::string& part) {
        std::string text = good;
        text.replace(text.find(from), from.size(), to);
        const std::string error = error_of(seal(text));
        EXPECT_NE(error.find(part), std::string::npos) << error;
    };
    expect_error("save 1", "save 2", "its version is 2, this program reads 1");
    expect_error("scene a room\n", "", "the line 'scene' is missing");
    expect_error("next ", "next 1\nnext ", "line 7: 'next' is there twice");
    expect_error("play 600", "play 601", "line 4: the step is 601");
    expect_error("play 600 ", "play 600 nan ", "line 4: the yaw is 'nan'");
    expect_error("person ", "person 1e9 ", "line 5: the place is '1e9'");
    expect_error("ball 0 ", "ball 50 ", "line 7: the ball is '50'");
    expect_error("crate ", "crate inf ", "the turn is 'inf'");
    expect_error("lantern 1", "lantern 2", "whether it is lit is '2'");
    expect_error("step ", "step 600 0 0 - 0 0 0\nstep ", "the count is '600'");
    expect_error("step ", "step 1 0 0 x 0 0 0\nstep ", "a restart is no step");
    expect_error("lantern", "lamp", "'lamp' begins no line");
}

// Words that are exchanged at random: whatever is accepted can be played.
TEST_F(PlaySave, NoTextWithARightSumCrashes) {
    const std::string good = describe_save(make_save());
    const Level level = make_playground();
    std::mt19937 random(3);
    int accepted = 0;
    for (int i = 0; i < 300; ++i) {
        std::string text = good;
        const std::size_t place = random() % (good.size() - 60);
        text.replace(place, random() % 12,
                     std::vector<std::string>{"9", " 1 ", "-", "1e6", "\n", ""}[random() % 6]);
        if (!error_of(seal(text)).empty()) continue;
        try {
            Simulation simulation(level);
            simulation.load(load_save(file_).play);
            tarn::test::run_steps(simulation, 20, tarn::test::go_ahead());
            ++accepted;
        } catch (const game::Error&) {
        }
    }
    EXPECT_GT(accepted, 10);
}

TEST_F(PlaySave, OfALevelWithOtherThingsItIsRefusedAndChangesNothing) {
    const SaveFile save = make_save();
    Level fewer_crates = make_playground(), more_lanterns = make_playground();
    fewer_crates.crates.resize(3);
    more_lanterns.lanterns.push_back(more_lanterns.lanterns[0]);
    for (const Level& level : {fewer_crates, more_lanterns}) {
        Simulation other(level);
        tarn::test::run_steps(other, 5, tarn::test::go_ahead());
        const std::uint64_t before = compute_hash(other.state());
        EXPECT_THROW(other.load(save.play), game::Error);
        EXPECT_EQ(compute_hash(other.state()), before);
    }
}

TEST_F(PlaySave, WhenAllWasLitIsKept) {
    const Level level = LevelBuilder().floor(20.0).lantern({0.0, 2.2, -2.0}, true).level();
    Simulation simulation(level), other(level);
    StepInput use;
    use.use = true;
    simulation.step(use);
    tarn::test::run_steps(simulation, game::SNAPSHOT_STEPS);
    EXPECT_EQ(simulation.state().finished_step, 1u);
    other.load(through_a_file(simulation.save()).play);
    EXPECT_EQ(other.state().finished_step, 1u);
    EXPECT_EQ(other.state().relit_count, 1);
}

}  // namespace
