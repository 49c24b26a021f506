// When the viewer takes what it shows to be at rest.
#include "game/rest_watch.h"

#include <gtest/gtest.h>

#include <functional>

namespace game {
namespace {

ShownState some_state() {
    ShownState state;
    state.size = {64, 32};
    state.settings = Settings::preset("clean");
    return state;
}

int count_until_rest(RestWatch& watch, const ShownState& state) {
    int frames = 1;
    while (!watch.is_at_rest(state) && frames < 100) ++frames;
    return frames;
}

TEST(RestWatch, waitsSomeFrames) {
    RestWatch watch;
    EXPECT_EQ(count_until_rest(watch, some_state()), RestWatch::REST_FRAMES + 1);
    EXPECT_TRUE(watch.is_at_rest(some_state()));
}

TEST(RestWatch, anyChangeStartsOver) {
    const std::vector<std::function<void(ShownState&)>> changes = {
        [](ShownState& s) { s.camera.position_ws.y += 1e-6; },
        [](ShownState& s) { s.camera.yaw_rad += 1e-6; },
        [](ShownState& s) { s.seed = 7; },
        [](ShownState& s) { s.time_s = 0.1; },
        [](ShownState& s) { s.size.width_px = 65; },
        [](ShownState& s) { s.settings.set("candidates", "9"); },
        [](ShownState& s) { s.settings.set("denoise", "off"); },
    };
    for (const auto& change : changes) {
        RestWatch watch;
        count_until_rest(watch, some_state());
        ShownState changed = some_state();
        change(changed);
        EXPECT_FALSE(watch.is_at_rest(changed));
        EXPECT_EQ(count_until_rest(watch, changed), RestWatch::REST_FRAMES);
    }
}

TEST(FreshSettings, keepNothingFromFrameToFrame) {
    for (const PresetInfo& preset : Settings::list_presets()) {
        const Settings fresh = Settings::preset(preset.name).fresh();
        EXPECT_NE(fresh.get("direct"), "restir") << preset.name;
        EXPECT_NE(fresh.get("indirect"), "restir") << preset.name;
        EXPECT_EQ(fresh.get("denoise"), "off") << preset.name;
        EXPECT_NE(fresh.get("antialias"), "taa") << preset.name;
        EXPECT_EQ(fresh.get("indirect-cache"), "off") << preset.name;
    }
    EXPECT_EQ(Settings::preset("clean").fresh().get("indirect"), "path");
    EXPECT_EQ(Settings::preset("clean").fresh().get("antialias"), "jitter");
    EXPECT_EQ(Settings::preset("fast").fresh().get("antialias"), "off");
    EXPECT_EQ(Settings::preset("fast").fresh().get("indirect"), "off") << "light that was off stays off";
}

}  // namespace
}  // namespace game
