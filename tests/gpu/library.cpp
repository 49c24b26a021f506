// The public surface: what a program that links Tarn can do, against the command line and against itself.
#include <gtest/gtest.h>

#include <limits>

#include "image_io/image_io.h"
#include "support/process.h"
// After the engine's own headers: it makes their names ambiguous inside of namespace tarn.
#include "gpu/library_floor.h"

namespace {

using tarn::test::read_text;
using tarn::test::run_tarn;
using tarn::test::TemporaryFolder;

const std::string CORNELL = TARN_BUILD_DIR "/content/cornell.glb";

class Library : public testing::Test {
  protected:
    static void SetUpTestSuite() { engine_ = std::make_unique<tarn::Engine>(); }
    static void TearDownTestSuite() { engine_.reset(); }

    static inline std::unique_ptr<tarn::Engine> engine_;
    TemporaryFolder folder_;
};

TEST_F(Library, APictureHasTheBitsOfTheCommandLine) {
    ASSERT_EQ(run_tarn({"render", CORNELL, "--size", "48x32", "--seed", "5", "--frames", "3", "--preset",
                        "fast", "--out", folder_.file("tarn.exr")})
                  .status,
              0);
    const tarn::Scene scene = tarn::Scene::load(CORNELL);
    tarn::View view(*engine_, scene, 48, 32);
    tarn::Frame frame = frame_of(scene.default_camera(1.5));
    frame.seed = 5;
    frame.settings = tarn::Settings::preset("fast");
    tarn::Picture picture;
    for (frame.number = 0; frame.number < 3; ++frame.number) picture = view.render(frame);
    picture.write_exr(folder_.file("library.exr"));
    EXPECT_EQ(picture.rgb, tarn::read_radiance(folder_.file("tarn.exr")).values);
    EXPECT_EQ(picture.rgb, tarn::read_radiance(folder_.file("library.exr")).values);
    const tarn::PictureNotes notes = {{"software", tarn::describe_version()}};
    EXPECT_EQ(tarn::read_exr_notes(folder_.file("library.exr")), notes);
    EXPECT_GT(picture.report.shadow_rays, 0u);
    EXPECT_GT(picture.report.frame_ms, 0.0);
    EXPECT_FALSE(picture.report.passes.empty());
    EXPECT_FALSE(picture.report.counters.empty());
    picture.write_png(folder_.file("a.png"));
    EXPECT_TRUE(read_text(folder_.file("a.png")).starts_with("\x89PNG"));
}

TEST_F(Library, LightsAndNodesCanBeMoved) {
    tarn::Scene scene = tarn::Scene::load(write_floor(folder_));
    tarn::View view(*engine_, scene, 16, 16);
    const double before = mean(view.render(frame_of(FROM_ABOVE, 0)));
    ASSERT_GT(before, 0.0);
    const tarn::Node lamp = scene.lights().at(0);
    EXPECT_EQ(lamp, scene.find_node("lamp"));

    tarn::Light light = scene.light(lamp);
    light.intensity = {2.0, 2.0, 2.0};
    scene.set_light(lamp, light);
    EXPECT_NEAR(mean(view.render(frame_of(FROM_ABOVE, 1))) / before, 2.0, 1e-4);

    tarn::Transform place = scene.transform(lamp);
    place.translation.y = 10.0;
    scene.set_transform(lamp, place);
    EXPECT_LT(mean(view.render(frame_of(FROM_ABOVE, 2))), 0.1 * before);

    tarn::Transform away;
    away.translation.x = 100.0;
    scene.set_transform(scene.find_node("floor"), away);
    EXPECT_EQ(mean(view.render(frame_of(FROM_ABOVE, 3))), 0.0);
}

TEST_F(Library, LightsComeAndGo) {
    tarn::Scene scene = tarn::Scene::load(write_floor(folder_));
    tarn::View view(*engine_, scene, 16, 16);
    const double one = mean(view.render(frame_of(FROM_ABOVE, 0)));
    const tarn::Node lamp = scene.lights().at(0);
    const tarn::Node second = scene.add_light(scene.light(lamp), scene.transform(lamp));
    EXPECT_EQ(scene.lights().size(), 2u);
    // Two alike in one place: whichever is drawn counts twice.
    EXPECT_NEAR(mean(view.render(frame_of(FROM_ABOVE, 1))) / one, 2.0, 1e-3);
    scene.remove_light(lamp);
    EXPECT_NEAR(mean(view.render(frame_of(FROM_ABOVE, 2))) / one, 1.0, 1e-3);
    scene.remove_light(second);
    EXPECT_EQ(mean(view.render(frame_of(FROM_ABOVE, 3))), 0.0);
    EXPECT_NE(error_of([&] { scene.light(lamp); }).find("'lamp' has no light"), std::string::npos);
}

TEST_F(Library, TwoViewsOfASceneSeeTheSame) {
    tarn::Scene scene = tarn::Scene::load(write_floor(folder_));
    tarn::View a(*engine_, scene, 16, 16), b(*engine_, scene, 16, 16);
    EXPECT_EQ(a.render(frame_of(FROM_ABOVE)).rgb, b.render(frame_of(FROM_ABOVE)).rgb);
    tarn::Transform place = scene.transform(scene.find_node("lamp"));
    place.translation.x = 0.5;
    scene.set_transform(scene.find_node("lamp"), place);
    EXPECT_EQ(a.render(frame_of(FROM_ABOVE, 1)).rgb, b.render(frame_of(FROM_ABOVE, 1)).rgb);
}

TEST_F(Library, AViewOutlivesItsSceneAndEngine) {
    std::unique_ptr<tarn::View> view;
    {
        const tarn::Engine engine;
        const tarn::Scene scene = tarn::Scene::load(write_floor(folder_));
        view = std::make_unique<tarn::View>(engine, scene, 8, 8);
    }
    EXPECT_GT(mean(view->render(frame_of(FROM_ABOVE))), 0.0);
}

TEST_F(Library, WhatIsDrawnCanBeReadAndShown) {
    const tarn::Scene scene = tarn::Scene::load(write_floor(folder_));
    tarn::View view(*engine_, scene, 8, 8);
    EXPECT_NE(error_of([&] { view.read(); }).find("not rendered"), std::string::npos);
    const tarn::FrameReport report = view.draw(frame_of(FROM_ABOVE));
    EXPECT_GT(report.shadow_rays, 0u);
    EXPECT_GT(mean(view.read()), 0.0);
    EXPECT_NE(view.texture(), 0u);
    EXPECT_NE(error_of([&] { view.present(8, 8); }).find("no window"), std::string::npos);
}

TEST(LibrarySettings, AreThoseOfTheTable) {
    tarn::Settings settings = tarn::Settings::preset("balanced");
    EXPECT_EQ(settings.get("neighbours"), "3");
    const tarn::Settings copy = settings;
    settings.set("neighbours", "2");
    EXPECT_EQ(settings.get("neighbours"), "2");
    EXPECT_EQ(copy.get("neighbours"), "3");
    for (const tarn::SettingInfo& info : tarn::Settings::list()) {
        settings.set(info.name, settings.get(info.name));
        EXPECT_FALSE(info.sentence.empty()) << info.name;
        EXPECT_TRUE(!info.choices.empty() || info.minimum < info.maximum) << info.name;
    }
    EXPECT_FALSE(tarn::Settings::list_presets().empty());
}

TEST(LibraryErrors, AreOneLineThatNamesWhatIsWrong) {
    const TemporaryFolder folder;
    tarn::Settings settings;
    const auto expect = [](const std::string& text, const std::string& part) {
        EXPECT_NE(text.find(part), std::string::npos) << text;
        EXPECT_EQ(text.find('\n'), std::string::npos) << text;
    };
    expect(error_of([&] { settings.set("neighbours", "many"); }), "neighbours: 'many'");
    expect(error_of([&] { settings.set("colour", "red"); }), "no setting 'colour'");
    expect(error_of([&] { tarn::Settings::preset("best"); }), "'best' is none of");
    expect(error_of([&] { tarn::Scene::load(folder.file("gone.glb")); }), "gone.glb");
    EXPECT_EQ(tarn::Scene::find_file("cornell"), CORNELL);
    EXPECT_EQ(tarn::Scene::find_file(folder.file("gone.glb")), folder.file("gone.glb"));
    expect(error_of([&] { tarn::Scene::find_file("nowhere"); }), "TARN_CONTENT_DIR");
    tarn::Scene scene = tarn::Scene::load(write_floor(folder));
    expect(error_of([&] { scene.camera("main"); }), "camera 'main': the scene has none");
    expect(error_of([&] { scene.find_node("nobody"); }), "no node 'nobody'");
    expect(error_of([&] { scene.move_to(std::numeric_limits<double>::infinity()); }), "inf");
    tarn::Transform flat;
    flat.rotation = {0.0, 0.0, 0.0, 0.0};
    expect(error_of([&] { scene.set_transform(scene.find_node("floor"), flat); }), "length 0");
    tarn::Light light;
    light.intensity.x = -1.0;
    expect(error_of([&] { scene.add_light(light, {}); }), "-1");
    expect(error_of([&] { tarn::Camera::look_at({}, {}, 180.0); }), "180 degrees");
    tarn::Picture picture;
    picture.width_px = 3;
    picture.height_px = 2;
    expect(error_of([&] { picture.write_exr(folder.file("a.exr")); }), "size");
}

}  // namespace
