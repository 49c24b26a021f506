// The game's window: its size, its end, and the number of threads that it gives to the driver.
#include "game/window.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

namespace game {
namespace {

bool has_display() {
    const char* display = std::getenv("DISPLAY");
    return display != nullptr && *display != '\0';
}

// Threads of this process that rasterize for Mesa's llvmpipe.
int count_rasterizers() {
    int count = 0;
    for (const auto& task : std::filesystem::directory_iterator("/proc/self/task")) {
        std::string name;
        std::getline(std::ifstream(task.path() / "comm"), name);
        count += name.starts_with("llvmpipe-");
    }
    return count;
}

TEST(GameWindow, OpensInItsSizeAndClosesWhenAsked) {
    if (!has_display()) GTEST_SKIP() << "no DISPLAY: the test game_window_in_xvfb brings its own";
    Window window({.title = "a game", .width_px = 320, .height_px = 200});
    EXPECT_EQ(window.framebuffer_size(), (Size{320, 200}));
    EXPECT_NE(window.gl_loader()("glClear"), nullptr);
    window.set_vsync(false);
    window.swap();
    window.poll_events();
    EXPECT_FALSE(window.is_minimized());
    EXPECT_FALSE(window.should_close());
    window.request_close();
    EXPECT_TRUE(window.should_close());
}

TEST(GameWindow, LimitsTheThreadsOfTheDriverAndLeavesTheEnvironmentAlone) {
    if (!has_display()) GTEST_SKIP() << "no DISPLAY: the test game_window_in_xvfb brings its own";
    unsetenv("LP_NUM_THREADS");
    const std::string device = Engine({.gl_loader = nullptr}).device_name();
    if (device.find("llvmpipe") == std::string::npos)
        GTEST_SKIP() << "a driver without such threads: " << device;
    for (const int threads : {1, 3}) {
        const int before = count_rasterizers();
        const Window window({.title = "a game", .width_px = 32, .height_px = 32, .gl_threads = threads});
        EXPECT_EQ(count_rasterizers() - before, threads);
        EXPECT_EQ(std::getenv("LP_NUM_THREADS"), nullptr);
    }
    setenv("LP_NUM_THREADS", "2", 1);
    const Window window({.title = "a game", .width_px = 32, .height_px = 32, .gl_threads = 1});
    EXPECT_STREQ(std::getenv("LP_NUM_THREADS"), "2");
}

TEST(GameWindow, SaysWhyItCannotOpen) {
    const char* display = std::getenv("DISPLAY");
    const std::string kept = display != nullptr ? display : "";
    unsetenv("DISPLAY");
    unsetenv("WAYLAND_DISPLAY");
    std::string message;
    try {
        const Window window({.title = "a game"});
    } catch (const Error& error) {
        message = error.what();
    }
    if (display != nullptr) setenv("DISPLAY", kept.c_str(), 1);
    EXPECT_NE(message.find("no window can be opened"), std::string::npos) << message;
    EXPECT_EQ(message.find('\n'), std::string::npos) << message;
}

}  // namespace
}  // namespace game
