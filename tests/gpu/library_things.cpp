// The public surface: triangles, surfaces, and things that come and go at run time.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <limits>
#include <sstream>

#include "support/process.h"
// After the engine's own headers: it makes their names ambiguous inside of namespace tarn.
#include "gpu/library_floor.h"

namespace {

using tarn::test::TemporaryFolder;

constexpr double PI = 3.14159265358979323846;

tarn::Transform at_place(double x, double y, double z) {
    tarn::Transform transform;
    transform.translation = {x, y, z};
    return transform;
}

tarn::Surface glowing(double radiance) {
    tarn::Surface surface;
    surface.emission = {radiance, radiance, radiance};
    return surface;
}

// By the divergence theorem; positive where triangles turn counter-clockwise as seen from outside.
double volume_of(const std::vector<tarn::Vec3>& corners) {
    double volume = 0.0;
    for (std::size_t i = 0; i + 2 < corners.size(); i += 3) {
        const tarn::Vec3 &a = corners[i], &b = corners[i + 1], &c = corners[i + 2];
        volume +=
            a.x * (b.y * c.z - b.z * c.y) + a.y * (b.z * c.x - b.x * c.z) + a.z * (b.x * c.y - b.y * c.x);
    }
    return volume / 6.0;
}

// The floor on a node that an animation lifts by a metre in a second.
std::string write_carried_floor(const TemporaryFolder& folder) {
    const std::string file = write_floor(folder);
    const float keys[] = {0, 1, 0, 0, 0, 0, 1, 0};  // two times, two translations
    std::ofstream(folder.file("floor.bin"), std::ios::binary | std::ios::app)
        .write(reinterpret_cast<const char*>(keys), sizeof(keys));
    std::stringstream text;
    text << std::ifstream(file).rdbuf();
    std::string json = text.str();
    const auto put = [&](const std::string& old, const std::string& fresh) {
        json.replace(json.find(old), old.size(), fresh);
    };
    put(R"("nodes": [0, 1])", R"("nodes": [2, 1])");
    put(R"({"light": 0}}}])", R"({"light": 0}}}, {"name": "carrier", "children": [0]}],
        "animations": [{"samplers": [{"input": 2, "output": 3}],
                        "channels": [{"sampler": 0, "target": {"node": 2, "path": "translation"}}]}])");
    put(R"("byteLength": 60)", R"("byteLength": 92)");
    put(R"("byteLength": 12}])", R"("byteLength": 12}, {"buffer": 0, "byteOffset": 60, "byteLength": 8},
                        {"buffer": 0, "byteOffset": 68, "byteLength": 24}])");
    put(R"("type": "SCALAR"}])", R"("type": "SCALAR"},
                      {"bufferView": 2, "componentType": 5126, "count": 2, "type": "SCALAR", "min": [0], "max": [1]},
                      {"bufferView": 3, "componentType": 5126, "count": 2, "type": "VEC3"}])");
    std::ofstream(file) << json;
    return file;
}

class Things : public testing::Test {
  protected:
    static void SetUpTestSuite() { engine_ = std::make_unique<tarn::Engine>(); }
    static void TearDownTestSuite() { engine_.reset(); }

    Things() : scene_(tarn::Scene::load(write_floor(folder_))), view_(*engine_, scene_, 16, 16) {}

    // The light on the floor, with little noise.
    double measure() {
        double sum = 0.0;
        for (int i = 0; i < FRAMES; ++i) sum += mean(view_.render(frame_of(FROM_ABOVE, number_++)));
        return sum / FRAMES;
    }

    static constexpr int FRAMES = 8;
    static inline std::unique_ptr<tarn::Engine> engine_;
    TemporaryFolder folder_;
    tarn::Scene scene_;
    tarn::View view_;
    std::uint32_t number_ = 0;
};

TEST_F(Things, TrianglesStandWhereTheirNodeIs) {
    scene_.set_transform(scene_.find_node("floor"), at_place(10.0, 2.0, 0.0));
    const std::vector<tarn::Triangles> all = scene_.triangles();
    ASSERT_EQ(all.size(), 1u);
    EXPECT_EQ(all[0].node, scene_.find_node("floor"));
    EXPECT_FALSE(all[0].is_animated);
    EXPECT_FALSE(all[0].has_holes);
    ASSERT_EQ(all[0].corners.size(), 6u);
    EXPECT_EQ(all[0].corners[5].x, 11.0);
    EXPECT_EQ(all[0].corners[5].y, 2.0);
    EXPECT_EQ(all[0].corners[5].z, 1.0);
}

// In the court things hang on nodes that swing, and leaves are cut out by their texture.
TEST_F(Things, TrianglesSayWhatAnimationsMoveAndWhatHasHoles) {
    tarn::Scene court = tarn::Scene::load(TARN_BUILD_DIR "/content/lantern_court.glb");
    court.move_to(0.2);
    const std::vector<tarn::Triangles> before = court.triangles();
    court.move_to(0.9);
    const std::vector<tarn::Triangles> after = court.triangles();
    ASSERT_EQ(before.size(), after.size());
    int moved = 0, holes = 0, still = 0;
    for (std::size_t i = 0; i < before.size(); ++i) {
        bool moves = false;
        for (std::size_t k = 0; k < before[i].corners.size(); ++k) {
            const tarn::Vec3 &a = before[i].corners[k], &b = after[i].corners[k];
            moves = moves || a.x != b.x || a.y != b.y || a.z != b.z;
        }
        if (moves) {
            EXPECT_TRUE(after[i].is_animated) << court.node_name(after[i].node);
        }
        moved += moves ? 1 : 0;
        still += after[i].is_animated ? 0 : 1;
        holes += after[i].has_holes ? 1 : 0;
    }
    EXPECT_GT(moved, 10);
    EXPECT_GT(still, 10);
    EXPECT_GT(holes, 0);
    EXPECT_LT(holes, int(after.size()) / 2);
}

TEST_F(Things, TrianglesSayThatTheirParentIsAnimated) {
    tarn::Scene scene = tarn::Scene::load(write_carried_floor(folder_));
    scene.move_to(0.5);
    const std::vector<tarn::Triangles> all = scene.triangles();
    ASSERT_EQ(all.size(), 1u);
    EXPECT_NEAR(all[0].corners[0].y, 0.5, 1e-6);
    EXPECT_TRUE(all[0].is_animated);
}

TEST_F(Things, ASurfaceIsWhatItWasSetTo) {
    const tarn::Surface set{{0.1, 0.25, 0.5}, 0.75, 0.125, {1.0, 2.0, 4.0}};
    scene_.set_surface(0, set);
    const tarn::Surface found = scene_.surface(0);
    EXPECT_NEAR(found.base_color.x, 0.1, 1e-6);
    EXPECT_EQ(found.base_color.y, 0.25);
    EXPECT_EQ(found.base_color.z, 0.5);
    EXPECT_EQ(found.roughness, 0.75);
    EXPECT_EQ(found.metallic, 0.125);
    EXPECT_EQ(found.emission.x, 1.0);
    EXPECT_EQ(found.emission.y, 2.0);
    EXPECT_EQ(found.emission.z, 4.0);
}

TEST_F(Things, SpheresAndBoxesAreClosedAndFaceOutwards) {
    const double radius_m = 0.5;
    scene_.add_sphere(radius_m, 3, {}, at_place(0.0, 1.0, 0.0));
    scene_.add_box({0.5, 1.0, 1.5}, {}, at_place(3.0, 1.0, 0.0));
    const std::vector<tarn::Triangles> all = scene_.triangles();
    ASSERT_EQ(all.size(), 3u);
    EXPECT_EQ(all[1].corners.size(), 3u * 20u * 64u);
    EXPECT_NEAR(volume_of(all[1].corners) / (4.0 / 3.0 * PI * std::pow(radius_m, 3.0)), 1.0, 0.01);
    EXPECT_EQ(all[2].corners.size(), 36u);
    EXPECT_NEAR(volume_of(all[2].corners), 6.0, 1e-6);
}

// From afar a sphere of radiance L sends L pi r^2 in every direction.
TEST_F(Things, AGlowingSphereLightsAsMuchAsAPointLightOfItsIntensity) {
    const double radius_m = 0.1, radiance = 40.0;
    tarn::Light light = scene_.light(scene_.lights().at(0));
    light.intensity = {radiance * PI * radius_m * radius_m, radiance * PI * radius_m * radius_m,
                       radiance * PI * radius_m * radius_m};
    scene_.set_light(scene_.lights().at(0), light);
    scene_.set_transform(scene_.lights().at(0), at_place(0.0, 2.0, 0.0));
    const double expected = measure();
    scene_.remove_light(scene_.lights().at(0));
    ASSERT_EQ(measure(), 0.0);
    scene_.add_sphere(radius_m, 3, glowing(radiance), at_place(0.0, 2.0, 0.0));
    EXPECT_NEAR(measure() / expected, 1.0, 0.03);
}

TEST_F(Things, SurfacesCanBeDimmedSwitchedOffAndOnAgain) {
    scene_.remove_light(scene_.lights().at(0));
    const tarn::Node ball = scene_.add_sphere(0.2, 1, glowing(10.0), at_place(0.0, 2.0, 0.0));
    ASSERT_EQ(scene_.materials(ball).size(), 1u);
    const std::size_t material = scene_.materials(ball)[0];
    const double before = measure();
    ASSERT_GT(before, 0.0);
    scene_.set_surface(material, glowing(5.0));
    EXPECT_EQ(scene_.surface(material).emission.x, 5.0);
    EXPECT_NEAR(measure() / before, 0.5, 0.02);
    scene_.set_surface(material, glowing(0.0));
    EXPECT_EQ(measure(), 0.0);
    scene_.set_surface(material, glowing(10.0));
    EXPECT_NEAR(measure() / before, 1.0, 0.03);
    scene_.remove_mesh(ball);
    EXPECT_EQ(measure(), 0.0);
    EXPECT_EQ(scene_.facts().light_triangles, 0u);
}

TEST_F(Things, ACopyShinesToo) {
    scene_.remove_light(scene_.lights().at(0));
    const tarn::Node first = scene_.add_sphere(0.2, 1, glowing(10.0), at_place(0.0, 2.0, 0.0));
    const double one = measure();
    const tarn::Node second = scene_.add_copy(first, at_place(50.0, 2.0, 0.0));
    EXPECT_EQ(scene_.materials(first), scene_.materials(second));
    EXPECT_NEAR(measure() / one, 1.0, 0.03);
    // Beside the first: by the cosines and the distance six to nine tenths of its light.
    scene_.set_transform(second, at_place(0.6, 2.0, 0.0));
    const double ratio = measure() / one;
    EXPECT_GT(ratio, 1.6);
    EXPECT_LT(ratio, 1.95);
}

TEST_F(Things, SeparatedMaterialsChangeOneNodeAlone) {
    scene_.remove_light(scene_.lights().at(0));
    const tarn::Node left = scene_.add_sphere(0.2, 1, glowing(10.0), at_place(-0.3, 2.0, 0.0));
    const tarn::Node right = scene_.add_copy(left, at_place(0.3, 2.0, 0.0));
    const double both = measure();
    scene_.separate_materials(right);
    EXPECT_NE(scene_.materials(left), scene_.materials(right));
    EXPECT_NEAR(measure() / both, 1.0, 0.03);
    scene_.set_surface(scene_.materials(right)[0], glowing(0.0));
    EXPECT_NEAR(measure() / both, 0.5, 0.03);
}

TEST_F(Things, EveryViewSeesWhatCameAndTheSkyStays) {
    tarn::SceneOptions options;
    options.sky = 2.0f;
    tarn::Scene scene = tarn::Scene::load(write_floor(folder_), options);
    tarn::View a(*engine_, scene, 16, 16), b(*engine_, scene, 8, 8);
    a.render(frame_of(FROM_ABOVE));
    scene.remove_light(scene.lights().at(0));
    const double under_the_sky = mean(b.render(frame_of(FROM_ABOVE)));
    ASSERT_GT(under_the_sky, 0.0);
    scene.add_box({0.8, 0.1, 0.8}, glowing(100.0), at_place(0.0, 1.0, 0.0));
    // What it emits, and what its albedo of 0.8 leaves of a sky of 2.
    EXPECT_NEAR(mean(a.render(frame_of(FROM_ABOVE))), 101.6, 0.5);
    EXPECT_NEAR(mean(b.render(frame_of(FROM_ABOVE))), 101.6, 0.5);
    EXPECT_EQ(a.width_px(), 16);
    EXPECT_EQ(b.width_px(), 8);
    scene.remove_mesh(tarn::Node{std::uint32_t(scene.node_count() - 1)});
    EXPECT_NEAR(mean(b.render(frame_of(FROM_ABOVE))) / under_the_sky, 1.0, 0.2);
    EXPECT_EQ(scene.facts().sky_width_px, 2);
}

TEST_F(Things, ErrorsNameWhatIsWrong) {
    const auto expect = [](const std::string& text, const std::string& part) {
        EXPECT_NE(text.find(part), std::string::npos) << text;
    };
    const std::size_t nodes = scene_.node_count();
    const tarn::Node lamp = scene_.find_node("lamp");
    tarn::Surface bad;
    bad.roughness = 1.5;
    expect(error_of([&] { scene_.add_sphere(0.1, 1, bad, {}); }), "roughness is 1.5");
    bad = glowing(-1.0);
    expect(error_of([&] { scene_.set_surface(0, bad); }), "-1");
    expect(error_of([&] { scene_.surface(99); }), "material 99: the scene has 1");
    expect(error_of([&] { scene_.add_sphere(0.0, 1, {}, {}); }), "radius is 0 m");
    expect(error_of([&] { scene_.add_sphere(std::nan(""), 1, {}, {}); }), "radius is nan");
    expect(error_of([&] { scene_.add_sphere(1.0, 7, {}, {}); }), "subdivisions are 7");
    expect(error_of([&] { scene_.add_box({1.0, 0.0, 1.0}, {}, {}); }), "half extent");
    expect(error_of([&] { scene_.add_copy(lamp, {}); }), "'lamp' has no mesh");
    expect(error_of([&] { scene_.remove_mesh(lamp); }), "'lamp' has no mesh");
    expect(error_of([&] { scene_.materials(tarn::Node{99}); }), "node 99");
    EXPECT_EQ(scene_.node_count(), nodes);
}

}  // namespace
