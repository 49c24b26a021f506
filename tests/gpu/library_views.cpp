// What a viewer asks of the public surface: ways to show a frame, exposure, reports, facts, shaders anew.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "image_io/image_io.h"
// After the engine's own headers: it makes their names ambiguous inside of namespace tarn.
#include "gpu/library_floor.h"

namespace {

using tarn::test::TemporaryFolder;

constexpr int SIZE_PX = 16;
constexpr double EXPOSURE_TOLERANCE_EV = 0.001;  // one rule over one histogram

tarn::PassTime find_pass(const tarn::FrameReport& report, const std::string& name) {
    const auto pass = std::find_if(report.passes.begin(), report.passes.end(),
                                   [&](const tarn::PassTime& p) { return p.name == name; });
    EXPECT_NE(pass, report.passes.end()) << name;
    return pass == report.passes.end() ? tarn::PassTime() : *pass;
}

class LibraryViews : public testing::Test {
  protected:
    static void SetUpTestSuite() { engine_ = std::make_unique<tarn::Engine>(); }
    static void TearDownTestSuite() { engine_.reset(); }

    LibraryViews()
        : scene_(tarn::Scene::load(write_floor(folder_))), view_(*engine_, scene_, SIZE_PX, SIZE_PX) {}

    // Draws the next frame; nullopt: automatic exposure.
    tarn::FrameReport draw(const std::string& view, std::optional<float> exposure_ev,
                           double elapsed_s = 0.02) {
        tarn::Frame frame = frame_of(FROM_ABOVE, number_++);
        frame.display = {view, exposure_ev, elapsed_s};
        return view_.draw(frame);
    }

    std::vector<float> read_shown() {
        view_.write_png(folder_.file("shown.png"));
        return tarn::read_png(folder_.file("shown.png")).values;
    }

    void multiply_lamp(double factor) {
        const tarn::Node lamp = scene_.lights().at(0);
        tarn::Light light = scene_.light(lamp);
        for (double* channel : {&light.intensity.x, &light.intensity.y, &light.intensity.z})
            *channel *= factor;
        scene_.set_light(lamp, light);
    }

    static inline std::unique_ptr<tarn::Engine> engine_;
    TemporaryFolder folder_;
    tarn::Scene scene_;
    tarn::View view_;
    std::uint32_t number_ = 0;
};

TEST_F(LibraryViews, TheShownPictureIsThatOfThePicturesFile) {
    for (const float exposure_ev : {-1.0f, 2.5f}) {
        draw("radiance", exposure_ev);
        EXPECT_EQ(view_.exposure_ev(), exposure_ev);
        view_.read().write_png(folder_.file("picture.png"), exposure_ev);
        const std::vector<float> expected = tarn::read_png(folder_.file("picture.png")).values;
        const std::vector<float> shown = read_shown();
        ASSERT_EQ(shown.size(), expected.size());
        for (std::size_t i = 0; i < shown.size(); ++i) ASSERT_NEAR(shown[i], expected[i], 1.01 / 255.0) << i;
    }
}

TEST_F(LibraryViews, OtherViewsShowOtherThings) {
    const std::vector<tarn::DisplayViewInfo> views = tarn::Display::list_views();
    ASSERT_GT(views.size(), 3u);
    EXPECT_EQ(views.front().name, tarn::Display().view);
    for (const tarn::DisplayViewInfo& view : views) {
        EXPECT_FALSE(view.sentence.empty()) << view.name;
        draw(view.name, 0.0f);
        EXPECT_NE(view_.texture(), 0u) << view.name;
    }
    // A floor looks up: half of red, all of green, half of blue.
    draw("geometric normals", 0.0f);
    const std::vector<float> normals = read_shown();
    const std::size_t middle = 3 * (SIZE_PX / 2 * SIZE_PX + SIZE_PX / 2);
    EXPECT_NEAR(normals[middle], 0.5f, 0.01f);
    EXPECT_NEAR(normals[middle + 1], 1.0f, 0.01f);
    EXPECT_NEAR(normals[middle + 2], 0.5f, 0.01f);
    const std::string error = error_of([&] { draw("beauty", 0.0f); });
    EXPECT_NE(error.find("'beauty'"), std::string::npos) << error;
    EXPECT_NE(error.find("radiance"), std::string::npos) << error;
}

TEST_F(LibraryViews, TheExposureFollowsThePictures) {
    draw("radiance", std::nullopt);
    const float before_ev = view_.exposure_ev();
    EXPECT_NEAR(before_ev, view_.read().auto_exposure_ev(), EXPOSURE_TOLERANCE_EV);
    multiply_lamp(16.0);
    for (int i = 0; i < 20; ++i) draw("radiance", std::nullopt, 0.0);
    EXPECT_NEAR(view_.exposure_ev(), before_ev, 1e-3) << "no time has gone by";
    for (int i = 0; i < 20; ++i) draw("radiance", std::nullopt, 0.01);
    EXPECT_LT(view_.exposure_ev(), before_ev - 0.5f) << "a fifth of a second";
    EXPECT_GT(view_.exposure_ev(), before_ev - 3.5f);
    for (int i = 0; i < 20; ++i) draw("radiance", std::nullopt, 10.0);
    EXPECT_NEAR(view_.exposure_ev(), before_ev - 4.0f, 1e-2);
}

TEST_F(LibraryViews, TheExposureOfOtherViewsIsThatOfThePicture) {
    draw("albedo", std::nullopt);
    EXPECT_NEAR(view_.exposure_ev(), view_.read().auto_exposure_ev(), EXPOSURE_TOLERANCE_EV);
}

TEST_F(LibraryViews, AReportSaysWhatWasDrawnTracedAndDecided) {
    tarn::Frame by_tree = frame_of(FROM_ABOVE, number_++);
    by_tree.settings.set("direct", "light-tree");
    const tarn::FrameReport report = view_.draw(by_tree);
    EXPECT_EQ(report.triangles_total, 2u);
    EXPECT_EQ(report.triangles_drawn, 2u);
    EXPECT_TRUE(find_pass(report, "visibility").traces_rays);
    EXPECT_FALSE(find_pass(report, "lights/tree").traces_rays);
    EXPECT_FALSE(find_pass(report, "gbuffer/raster").traces_rays);
    EXPECT_FALSE(find_pass(report, "display").traces_rays);
    const auto decided = [&](const std::string& define) {
        return std::any_of(report.plan.begin(), report.plan.end(), [&](const tarn::PlanReason& entry) {
            EXPECT_FALSE(entry.reason.empty()) << entry.name;
            return entry.name == define;
        });
    };
    EXPECT_TRUE(decided("TARN_PUNCTUAL_LIGHTS"));
    EXPECT_FALSE(decided("TARN_TRIANGLE_LIGHTS"));

    EXPECT_EQ(report.camera_rays, 0u);

    tarn::Frame by_rays = frame_of(FROM_ABOVE, number_++);
    by_rays.settings.set("primary", "rays");
    const tarn::FrameReport traced = view_.draw(by_rays);
    EXPECT_TRUE(find_pass(traced, "gbuffer/rays").traces_rays);
    EXPECT_EQ(traced.camera_rays, std::uint64_t(SIZE_PX * SIZE_PX));
    EXPECT_EQ(traced.triangles_drawn, 0u);
    EXPECT_EQ(traced.triangles_total, 2u);

    tarn::Frame away = frame_of(tarn::Camera::look_at({0.0, 1.5, 0.0}, {0.0, 3.0, 0.0}, 40.0));
    EXPECT_EQ(view_.draw(away).triangles_drawn, 0u);
}

TEST_F(LibraryViews, FactsCountWhatTheSceneHolds) {
    tarn::SceneFacts facts = scene_.facts();
    EXPECT_EQ(facts.triangles, 2u);
    EXPECT_EQ(facts.instances, 1u);
    EXPECT_EQ(facts.textures, 0u);
    EXPECT_EQ(facts.punctual_lights, 1u);
    EXPECT_EQ(facts.light_triangles, 0u);
    EXPECT_EQ(facts.sky_width_px, 0);
    scene_.add_light({}, {});
    draw("radiance", 0.0f);
    EXPECT_EQ(scene_.facts().punctual_lights, 2u);

    tarn::SceneOptions options;
    options.sky = 1.0f;
    facts = tarn::Scene::load(folder_.file("floor.gltf"), options).facts();
    EXPECT_GT(facts.sky_width_px, 0);
    EXPECT_GT(facts.sky_height_px, 0);
}

TEST(LibraryShaders, AreReadAgainAndKeptWhereTheyAreWrong) {
    const TemporaryFolder folder;
    const std::filesystem::path shaders = folder.path() / "shaders";
    std::filesystem::copy(TARN_SOURCE_DIR "/shaders", shaders, std::filesystem::copy_options::recursive);
    setenv("TARN_SHADER_DIR", shaders.c_str(), 1);
    {
        const tarn::Engine engine;
        const tarn::Scene scene = tarn::Scene::load(write_floor(folder));
        tarn::View view(engine, scene, SIZE_PX, SIZE_PX);
        view.draw(frame_of(FROM_ABOVE));
        EXPECT_EQ(view.reload_shaders(), "");

        const std::string name = "passes/direct/shade.comp";
        const std::string text = tarn::test::read_text(shaders / name);
        std::ofstream(shaders / name) << text << "\nthis is no GLSL\n";
        EXPECT_NE(view.reload_shaders().find(name), std::string::npos);
        EXPECT_GT(mean(view.render(frame_of(FROM_ABOVE))), 0.0) << "the old version stays";

        std::ofstream(shaders / name) << text << "\n// it is again\n";
        EXPECT_EQ(view.reload_shaders(), "");
    }
    unsetenv("TARN_SHADER_DIR");
}

TEST(LibrarySettings, AreNumbersToWidgets) {
    tarn::Settings settings;
    settings.set("direct", "uniform");
    EXPECT_EQ(settings.number("direct"), 0.0);  // the first of its choices
    EXPECT_FALSE(settings.applies("candidates"));
    settings.set_number("direct", 3.0);
    EXPECT_EQ(settings.get("direct"), "ris");
    EXPECT_TRUE(settings.applies("candidates"));
    EXPECT_TRUE(settings.applies("direct"));
    settings.set_number("candidates", 8.0);
    EXPECT_EQ(settings.get("candidates"), "8");
    EXPECT_EQ(settings.number("candidates"), 8.0);
    for (const double wrong : {0.0, 8.5, 1e9, std::nan("")}) {
        EXPECT_NE(error_of([&] { settings.set_number("candidates", wrong); }).find("candidates: "),
                  std::string::npos)
            << wrong;
    }
    EXPECT_NE(error_of([&] { settings.set_number("direct", 5.0); }).find("direct: 5"), std::string::npos);
    EXPECT_EQ(settings.number("candidates"), 8.0) << "what is refused changes nothing";
    EXPECT_NE(error_of([&] { settings.number("colour"); }).find("colour"), std::string::npos);
    EXPECT_NE(error_of([&] { (void)settings.applies("colour"); }).find("colour"), std::string::npos);
}

}  // namespace
