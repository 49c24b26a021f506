// Cameras inside of things and along surfaces, materials at both ends of roughness: pictures stay finite and
// counters at zero.
#include <gtest/gtest.h>

#include "support/on_context.h"
#include "support/toy_render.h"

namespace tarn::test {
namespace {

constexpr int WIDTH_PX = 97;
constexpr int HEIGHT_PX = 65;
const DirectMode MODES[] = {DirectMode::UNIFORM, DirectMode::RIS};

class OddViews : public OnContext<> {};

// A ball of 2 m with a point light in its middle, and the camera beside it: whatever is seen is lit by
// I / d^2 cos albedo / pi.
Scene make_lit_ball(bool double_sided) {
    ToyScene toy;
    Material material = lambert_material(glm::vec3(0.5f));
    material.double_sided = double_sided;
    toy.add_instance(toy.add_mesh(toy.add_material(material), sphere_corners(2.0f, 32)));
    toy.add_light(make_point(4.0f), at_place(0.0, 0.0, 0.0));
    return toy.scene;
}

TEST_F(OddViews, InsideADoubleSidedBallEveryPixelIsLit) {
    ToyRender render(make_lit_ball(true), WIDTH_PX, HEIGHT_PX);
    for (const DirectMode mode : MODES) {
        for (const glm::dvec3& place : {glm::dvec3(0.5, 0.2, 0.1), glm::dvec3(0.0, 0.0, 1.9)}) {
            const Image image = render.render(render.look(place, {0.1, 0.1, 0.0}, 100.0), mode);
            for (std::size_t i = 0; i < image.values.size(); ++i) {
                // 32 bands: facets lie up to 0.5 % inside of the ball.
                ASSERT_NEAR(image.values[i], 0.5 / 3.14159265 * 4.0 / 4.0, 0.02) << i;
            }
        }
    }
}

// glTF culls back faces: from inside a single-sided ball there is nothing to see, and no even sky since there
// is a light.
TEST_F(OddViews, InsideASingleSidedBallThereIsNothing) {
    ToyRender render(make_lit_ball(false), WIDTH_PX, HEIGHT_PX);
    for (const DirectMode mode : MODES) {
        EXPECT_EQ(mean_of(render.render(render.look({0.5, 0.2, 0.1}, {0.0, 0.0, 0.0}, 100.0), mode)), 0.0);
    }
}

// The near plane and the triangle's own plane through the camera.
TEST_F(OddViews, ACameraInTheFloorIsFinite) {
    ToyScene toy;
    Material material = lambert_material(glm::vec3(0.5f));
    material.double_sided = true;
    const MaterialIndex grey = toy.add_material(material);
    toy.add_quad(grey, {-4.0f, 0.0f, 4.0f}, {8.0f, 0.0f, 0.0f}, {0.0f, 0.0f, -8.0f});
    toy.add_instance(toy.add_mesh(grey, sphere_corners(0.5f, 12)), at_place(0.0, 0.25, -2.0));
    toy.add_light(make_point(5.0f), at_place(0.0, 1.0, -1.0));
    ToyRender render(toy.scene, WIDTH_PX, HEIGHT_PX);
    for (const DirectMode mode : MODES) {
        for (const glm::dvec3& target :
             {glm::dvec3(0.0, 0.0, -2.0), glm::dvec3(0.0, 0.0, -1.999), glm::dvec3(0, 1, 0)}) {
            render.render(render.look({0.0, 0.0, 0.0}, target, 60.0), mode, 2);
        }
    }
}

// ---- Materials at the ends of their range, seen and lit at grazing angles -----------------------

struct Finish {
    const char* name;
    float metallic;
    float roughness;
};

void PrintTo(const Finish& finish, std::ostream* out) {
    *out << finish.name;
}

class GrazingViews : public OddViews, public testing::WithParamInterface<Finish> {};

TEST_P(GrazingViews, AreFiniteAndLit) {
    ToyScene toy;
    Material material;
    material.base_color = glm::vec4(0.9f, 0.8f, 0.7f, 1.0f);
    material.metallic = GetParam().metallic;
    material.roughness = GetParam().roughness;
    const MaterialIndex floor = toy.add_material(material);
    const MaterialIndex lamp = toy.add_material(emissive_material(glm::vec3(100.0f)));
    toy.add_quad(floor, {-50.0f, 0.0f, 50.0f}, {100.0f, 0.0f, 0.0f}, {0.0f, 0.0f, -100.0f});
    // Straight ahead where the mirror image of the view goes: both meet the floor at a ten-thousandth of a
    // radian.
    toy.add_quad(lamp, {-20.0f, 0.0f, -49.0f}, {40.0f, 0.0f, 0.0f}, {0.0f, 10.0f, 0.0f});
    toy.add_light(make_point(10.0f), at_place(0.0, 0.002, -20.0));
    toy.add_light(make_point(10.0f), at_place(0.0, 2.0, -10.0));
    ToyRender render(toy.scene, WIDTH_PX, HEIGHT_PX);
    for (const DirectMode mode : MODES) {
        // 89.99 degrees from the normal, and the usual way down.
        const Image grazing =
            render.render(render.look({0.0, 0.002, 0.0}, {0.0, -0.0005, -14.0}, 1.0), mode, 4);
        const Image steep = render.render(render.look({0.0, 3.0, 0.0}, {0.0, 0.0, -10.0}, 60.0), mode, 4);
        EXPECT_GT(mean_of(grazing), 0.0);
        EXPECT_GT(mean_of(steep), 0.0);
    }
}

INSTANTIATE_TEST_SUITE_P(Finishes, GrazingViews,
                         testing::Values(Finish{"SmoothDielectric", 0.0f, 0.0f},
                                         Finish{"RoughDielectric", 0.0f, 1.0f},
                                         Finish{"SmoothMetal", 1.0f, 0.0f}, Finish{"RoughMetal", 1.0f, 1.0f}),
                         [](const auto& info) { return info.param.name; });

// A plain of 300 km under the sun, seen by someone who stands on it: every pixel below the horizon has the
// radiance E cos albedo / pi, the ground before the feet as well.
TEST_F(OddViews, WhoStandsOnGroundThatReachesToTheHorizonSeesIt) {
    constexpr float SIZE_M = 3e5f;
    ToyScene toy;
    toy.add_quad(toy.add_material(lambert_material(glm::vec3(0.5f))), {-SIZE_M / 2, 0, SIZE_M / 2},
                 {SIZE_M, 0, 0}, {0, 0, -SIZE_M});
    PunctualLight sun;
    sun.kind = LightKind::DIRECTIONAL;
    sun.intensity = glm::vec3(2.0f);
    toy.add_light(sun, glm::rotate(glm::dmat4(1.0), glm::radians(-90.0), glm::dvec3(1, 0, 0)));
    ToyRender render(toy.scene, WIDTH_PX, HEIGHT_PX);
    const CameraRecord camera = render.look({10.0, 1.7, 20.0}, {10.0, 1.2, 10.0}, 60.0);
    const Image image = render.render(camera, DirectMode::RIS);
    int below = 0;
    for (int y = 0; y < HEIGHT_PX; ++y) {
        for (int x = 0; x < WIDTH_PX; ++x) {
            if (render.ray_direction(camera, x, y).y > -0.01) continue;
            ++below;
            ASSERT_NEAR(image.pixel(x, y)[1], 0.5 / 3.14159265 * 2.0, 1e-4) << x << ", " << y;
        }
    }
    EXPECT_GT(below, WIDTH_PX * HEIGHT_PX / 3);
}

}  // namespace
}  // namespace tarn::test
