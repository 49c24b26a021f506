// Files that somebody drops on the sandbox's window: good ones are played in, of broken ones it says what is
// wrong.
#include <gtest/gtest.h>
#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <cstdlib>
#include <fstream>

#include "game/sandbox/sandbox.h"
#include "support/process.h"

namespace game {
namespace {

const std::string CONTENT = TARN_BUILD_DIR "/content/";

// What a file manager sends.
void drop(Window& window, const std::string& file) {
    const GLFWdropfun callback = glfwSetDropCallback(window.native_handle(), nullptr);
    ASSERT_NE(callback, nullptr);
    glfwSetDropCallback(window.native_handle(), callback);
    const char* files[] = {file.c_str()};
    callback(window.native_handle(), 1, files);
}

// 4 x 2 pixels of blue.
void write_sky(const std::string& file) {
    std::ofstream stream(file, std::ios::binary);
    stream << "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 2 +X 4\n";
    for (int i = 0; i < 8; ++i) stream.write("\x10\x20\x80\x81", 4);
}

TEST(StageSource, IsChosenByTheEndingOfAFile) {
    const StageSource now{"lantern_court", "night.exr"};
    EXPECT_EQ(with_file(now, "a b/c.glb"), (StageSource{"a b/c.glb", {}}));
    EXPECT_EQ(with_file(now, "C.GLTF"), (StageSource{"C.GLTF", {}}));
    EXPECT_EQ(with_file(now, "dusk.hdr"), (StageSource{"lantern_court", "dusk.hdr"}));
    EXPECT_EQ(with_file(now, "dusk.EXR"), (StageSource{"lantern_court", "dusk.EXR"}));
    for (const char* other : {"picture.png", "glb", "", "folder/"})
        EXPECT_THROW(with_file(now, other), Error);
}

TEST(StageSource, LoadsItsSky) {
    tarn::test::TemporaryFolder folder;
    write_sky(folder.file("sky.hdr"));
    EXPECT_EQ(load_stage({CONTENT + "corner.glb", folder.file("sky.hdr")})->scene().facts().sky_width_px, 4);
    EXPECT_THROW(load_stage({CONTENT + "corner.glb", folder.file("gone.hdr")}), Error);
    EXPECT_THROW(load_stage({folder.file("gone.glb"), {}}), Error);
}

class DroppedFiles : public testing::Test {
  protected:
    // Plays; before each frame `visit` is told its number, until it returns true.
    void play(const std::function<bool(Sandbox&, Window&, int)>& visit) {
        SandboxOptions options;
        options.source.scene = CONTENT + "corner.glb";
        options.settings = Settings::preset("clean");
        options.settings.set_number("scale", 0.25);
        options.record = folder_.file("a.replay");
        Window window({"test", 160, 96, 0});
        Sandbox* running = nullptr;
        int frame = 0;
        options.stop = [&] { return frame > 200 || visit(*running, window, frame++); };
        Sandbox sandbox(window, load_stage(options.source), options);
        running = &sandbox;
        sandbox.run();
    }

    tarn::test::TemporaryFolder folder_;
};

TEST_F(DroppedFiles, OnesThatAreBrokenLeaveAllAsItIsAndSayWhy) {
    if (std::getenv("DISPLAY") == nullptr) GTEST_SKIP() << "no DISPLAY: sandbox_files_in_xvfb brings its own";
    for (const char* name : {"broken.glb", "broken.hdr", "broken.exr", "picture.png"})
        std::ofstream(folder_.file(name)) << "no such thing";
    const std::vector<std::string> files = {"broken.glb", "gone.gltf", "broken.hdr", "broken.exr",
                                            "picture.png"};
    const Stage* stage = nullptr;
    std::uint64_t last_step = 0;
    std::size_t dropped = 0;
    play([&](Sandbox& sandbox, Window& window, int frame) {
        if (frame == 0) stage = &sandbox.stage();
        if (frame % 10 == 1 && dropped < files.size()) drop(window, folder_.file(files[dropped++]));
        if (frame % 10 != 9) return false;
        EXPECT_NE(sandbox.message().find(files[dropped - 1]), std::string::npos) << sandbox.message();
        EXPECT_EQ(sandbox.message().find('\n'), std::string::npos) << sandbox.message();
        EXPECT_EQ(&sandbox.stage(), stage);
        EXPECT_EQ(sandbox.source().scene, CONTENT + "corner.glb");
        EXPECT_GT(sandbox.stage().state().step, last_step);
        last_step = sandbox.stage().state().step;
        return dropped == files.size();
    });
    EXPECT_EQ(dropped, files.size());
    EXPECT_TRUE(load_replay(folder_.file("a.replay")).is_complete);
    EXPECT_EQ(load_replay(folder_.file("a.replay")).steps.size(), last_step);
}

TEST_F(DroppedFiles, ASceneIsPlayedInAndAPictureIsItsSky) {
    if (std::getenv("DISPLAY") == nullptr) GTEST_SKIP() << "no DISPLAY: sandbox_files_in_xvfb brings its own";
    write_sky(folder_.file("sky.hdr"));
    const std::string cornell = CONTENT + "cornell.glb";
    std::uint64_t first_level = 0, first_steps = 0;
    play([&](Sandbox& sandbox, Window& window, int frame) {
        const Stage& stage = sandbox.stage();
        if (frame == 0) first_level = stage.level_hash();
        if (frame == 4) {
            first_steps = stage.state().step;
            drop(window, cornell);
        }
        if (frame == 8) {
            EXPECT_EQ(sandbox.source(), (StageSource{cornell, {}})) << sandbox.message();
            EXPECT_NE(stage.level_hash(), first_level);
            EXPECT_NE(sandbox.message().find("the record has ended"), std::string::npos) << sandbox.message();
            EXPECT_NE(stage.scene().facts().sky_width_px, 4);
            drop(window, folder_.file("sky.hdr"));
        }
        if (frame < 12) return false;
        EXPECT_EQ(sandbox.source(), (StageSource{cornell, folder_.file("sky.hdr")})) << sandbox.message();
        EXPECT_EQ(stage.scene().facts().sky_width_px, 4);
        return true;
    });
    const Replay replay = load_replay(folder_.file("a.replay"));
    EXPECT_TRUE(replay.is_complete);
    EXPECT_EQ(replay.level_hash, first_level);
    EXPECT_EQ(replay.steps.size(), first_steps);
}

}  // namespace
}  // namespace game
