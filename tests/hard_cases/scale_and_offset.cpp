// Scenes of half a millimetre and of five kilometres, and scenes far from the origin: no acne, no leaks, the
// same light.
#include <gtest/gtest.h>

#include "scene/gltf_import.h"
#include "support/on_context.h"
#include "support/test_scenes.h"
#include "support/toy_render.h"

namespace tarn::test {
namespace {

constexpr int WIDTH_PX = 160;
constexpr int HEIGHT_PX = 90;

class HardScenes : public OnContext<> {};

glm::dmat4 scaled_by(double scale) {
    return glm::scale(glm::dmat4(1.0), glm::dvec3(scale));
}

// Not along one axis, and not a whole number of metres.
glm::dmat4 moved_by(double offset_m) {
    const double fraction_m = offset_m > 0.0 ? 0.37 : 0.0;
    return glm::translate(glm::dmat4(1.0),
                          glm::dvec3(offset_m + fraction_m, -0.5 * offset_m, 0.75 * offset_m));
}

ToyRender load_moved(const char* name, const glm::dmat4& ws_from_old) {
    Scene scene = load_gltf(content_file(name));
    transform_scene(scene, ws_from_old);
    return ToyRender(std::move(scene), WIDTH_PX, HEIGHT_PX);
}

// ---- Scale --------------------------------------------------------------------------------------

class Scale : public HardScenes, public testing::WithParamInterface<double> {};

// Radiance under area lights does not change with scale, and the random numbers are the same, so that the
// pictures are.
TEST_P(Scale, TheCornellBoxLooksTheSame) {
    for (const DirectMode mode : {DirectMode::UNIFORM, DirectMode::RIS}) {
        ToyRender plain = load_moved("cornell", glm::dmat4(1.0));
        ToyRender scaled = load_moved("cornell", scaled_by(GetParam()));
        const Image expected = plain.render(plain.first_camera(), mode);
        const Image actual = scaled.render(scaled.first_camera(), mode);
        int different = 0, lit = 0;
        for (std::size_t i = 0; i < expected.values.size(); ++i) {
            const float a = expected.values[i], b = actual.values[i];
            if (std::abs(a - b) > 1e-3f * a) ++different;
            if (a > 0.0f) ++lit;
        }
        EXPECT_GT(lit, int(expected.values.size()) / 5);
        // Rounding moves an edge or decides about a shadow ray at the edge of a shadow here and there.
        EXPECT_LE(different, int(expected.values.size()) / 500);
    }
}

INSTANTIATE_TEST_SUITE_P(Scales, Scale, testing::Values(1e-3, 1e4), [](const auto& info) {
    return info.param < 1.0 ? "Thousandth" : "TenThousandfold";
});

// ---- A light over a plane, known in closed form -------------------------------------------------

struct Placement {
    const char* name;
    double scale;
    double offset_m;
};

void PrintTo(const Placement& placement, std::ostream* out) {
    *out << placement.name;
}

class OverPlane : public HardScenes, public testing::WithParamInterface<Placement> {
  protected:
    static ToyRender load_placed(const char* name) {
        return load_moved(name, moved_by(GetParam().offset_m) * scaled_by(GetParam().scale));
    }
};

// Where the pixel's ray meets the plane y = 0 of the unmoved scene, in its coordinates, in double precision.
glm::dvec3 find_plane_point(const ToyRender& render, const CameraRecord& camera, int x, int y,
                            const Placement& placed) {
    const glm::dmat4 old_from_ws = glm::inverse(moved_by(placed.offset_m) * scaled_by(placed.scale));
    const glm::dvec3 origin(old_from_ws * glm::dvec4(render.camera_position_ws(camera), 1.0));
    const glm::dvec3 direction = render.ray_direction(camera, x, y);
    return origin + direction * (-origin.y / direction.y);
}

// One light, nothing in its way: every pixel of the plane is lit, in every frame, as the inverse square law
// says.
TEST_P(OverPlane, APointLightLightsEveryPixelByTheInverseSquareLaw) {
    const double square = GetParam().scale * GetParam().scale;
    for (const DirectMode mode : {DirectMode::UNIFORM, DirectMode::RIS}) {
        ToyRender render = load_placed("point_over_plane");
        const CameraRecord camera = render.first_camera();
        const Image image = render.render(camera, mode);
        int plane = 0, wrong = 0;
        double worst = 0.0;
        for (int y = 0; y < HEIGHT_PX; ++y) {
            for (int x = 0; x < WIDTH_PX; ++x) {
                if (render.seen_instance(x, y) == INVALID_INDEX) continue;
                ++plane;
                // 10 W/sr at height 1 over albedo 0.5.
                const glm::dvec3 p = find_plane_point(render, camera, x, y, GetParam());
                const double distance2 = p.x * p.x + 1.0 + p.z * p.z;
                const double expected =
                    0.5 / 3.14159265358979 * 10.0 / (distance2 * std::sqrt(distance2)) / square;
                const double error = std::abs(image.pixel(x, y)[1] / expected - 1.0);
                worst = std::max(worst, error);
                if (!(error < 1e-4)) ++wrong;
            }
        }
        std::printf("%d pixels of the plane, worst relative error %.2g\n", plane, worst);
        EXPECT_GT(plane, WIDTH_PX * HEIGHT_PX / 2);
        EXPECT_EQ(wrong, 0);
    }
}

TEST_P(OverPlane, ARectangleLightsEveryPixel) {
    for (const DirectMode mode : {DirectMode::UNIFORM, DirectMode::RIS}) {
        ToyRender render = load_placed("rectangle_over_plane");
        const CameraRecord camera = render.first_camera();
        int black = 0, plane = 0;
        for (int frame = 0; frame < 4; ++frame) {
            const Image image = render.render(camera, mode, 1, frame);
            for (int y = 0; y < HEIGHT_PX; ++y) {
                for (int x = 0; x < WIDTH_PX; ++x) {
                    if (render.seen_instance(x, y) != 0) continue;
                    ++plane;
                    if (!(image.pixel(x, y)[1] > 0.0f)) ++black;
                }
            }
        }
        EXPECT_GT(plane, WIDTH_PX * HEIGHT_PX / 2);
        EXPECT_EQ(black, 0);
    }
}

INSTANTIATE_TEST_SUITE_P(Placements, OverPlane,
                         testing::Values(Placement{"Origin", 1.0, 0.0}, Placement{"OneKilometre", 1.0, 1e3},
                                         Placement{"HundredKilometres", 1.0, 1e5},
                                         Placement{"Tiny", 1e-3, 0.0}, Placement{"Huge", 1e4, 0.0}),
                         [](const auto& info) { return info.param.name; });

// ---- A closed box with the lights outside -------------------------------------------------------

// Corners of a box around the origin, 12 triangles that share 8 corners, fronts inwards.
std::vector<glm::vec3> closed_box(const glm::vec3& half) {
    const auto corner = [&](int i) {
        return half * glm::vec3(i & 1 ? 1.0f : -1.0f, i & 2 ? 1.0f : -1.0f, i & 4 ? 1.0f : -1.0f);
    };
    const int faces[6][4] = {{0, 2, 6, 4}, {1, 5, 7, 3}, {0, 4, 5, 1},
                             {2, 3, 7, 6}, {0, 1, 3, 2}, {4, 6, 7, 5}};
    std::vector<glm::vec3> corners;
    for (const auto& f : faces) {
        for (const int i : {f[0], f[1], f[2], f[0], f[2], f[3]}) corners.push_back(corner(i));
    }
    // Every face's front looks at the origin.
    for (std::size_t i = 0; i < corners.size(); i += 3) {
        const glm::vec3 normal = glm::cross(corners[i + 1] - corners[i], corners[i + 2] - corners[i]);
        if (glm::dot(normal, corners[i]) > 0.0f) std::swap(corners[i + 1], corners[i + 2]);
    }
    return corners;
}

PunctualLight make_punctual(LightKind kind, float intensity) {
    PunctualLight light;
    light.kind = kind;
    light.intensity = glm::vec3(intensity);
    return light;
}

// A turned box, a point light just outside each face, a sun and an emissive rectangle; the camera inside.
Scene make_dark_room(bool with_box) {
    ToyScene toy;
    const MaterialIndex white = toy.add_material(lambert_material(glm::vec3(0.8f)));
    const MaterialIndex lamp = toy.add_material(emissive_material(glm::vec3(1000.0f)));
    const glm::dmat4 turned =
        glm::rotate(glm::rotate(glm::dmat4(1.0), 0.7, {0.0, 1.0, 0.0}), 0.4, {1.0, 0.0, 1.0});
    if (with_box) toy.add_instance(toy.add_mesh(white, closed_box({2.0f, 1.5f, 1.7f})), turned);
    // Something inside for light to fall on.
    toy.add_instance(toy.add_mesh(white, sphere_corners(0.5f, 8)), glm::translate(turned, {0.6, -0.4, 0.2}));
    for (const glm::dvec3& place :
         {glm::dvec3(2.05, 0.3, 0.2), glm::dvec3(-2.05, 0.1, 0.4), glm::dvec3(0.2, 1.55, 0.1),
          glm::dvec3(0.3, -1.55, 0.2), glm::dvec3(0.1, 0.3, 1.75), glm::dvec3(0.4, 0.2, -1.75)}) {
        toy.add_light(make_punctual(LightKind::POINT, 100.0f), glm::translate(turned, place));
    }
    toy.add_light(make_punctual(LightKind::DIRECTIONAL, 10.0f),
                  glm::rotate(glm::dmat4(1.0), -1.0, {1.0, 0.0, 0.0}));
    toy.add_quad(lamp, {-3.0f, 4.0f, -3.0f}, {6.0f, 0.0f, 0.0f}, {0.0f, 0.0f, 6.0f});
    return toy.scene;
}

class DarkRoom : public HardScenes, public testing::WithParamInterface<double> {
  protected:
    static int count_lit(Image image) {
        return int(std::count_if(image.values.begin(), image.values.end(), [](float v) { return v > 0.0f; }));
    }

    static Image look_inside(bool with_box, DirectMode mode, const glm::dvec3& target) {
        Scene scene = make_dark_room(with_box);
        transform_scene(scene, moved_by(GetParam()));
        ToyRender render(std::move(scene), WIDTH_PX, HEIGHT_PX);
        const glm::dvec3 centre(moved_by(GetParam())[3]);
        return render.render(render.look(centre, centre + target, 90.0), mode, 8);
    }
};

TEST_P(DarkRoom, StaysExactlyBlackInside) {
    for (const DirectMode mode : {DirectMode::UNIFORM, DirectMode::RIS}) {
        for (const glm::dvec3& target :
             {glm::dvec3(1, 0, 0), glm::dvec3(-1, 0.5, 0.3), glm::dvec3(0.1, -1, 1)}) {
            EXPECT_EQ(count_lit(look_inside(true, mode, target)), 0);
        }
    }
}

TEST_P(DarkRoom, IsLitWithoutTheBox) {
    EXPECT_GT(count_lit(look_inside(false, DirectMode::RIS, {0.6, -0.4, 0.2})), 500);
}

INSTANTIATE_TEST_SUITE_P(Offsets, DarkRoom, testing::Values(0.0, 1e3, 1e5),
                         [](const auto& info) { return "Metres" + std::to_string(int(info.param)); });

}  // namespace
}  // namespace tarn::test
