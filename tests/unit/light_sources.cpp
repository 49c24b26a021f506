// From a scene's emissive triangles to its table of lights: which side shines, where, and with what power.
#include <gtest/gtest.h>

#include <cmath>

#include "support/draws.h"
#include "support/toy_scenes.h"
#include "world/scene_access.h"

namespace tarn {
namespace {

using glm::dvec3;
using test::Draws;

// Turned, stretched, moved and, where asked for, mirrored.
glm::dmat4 random_transform(Draws& draws, bool mirrored) {
    const glm::dmat4 moved = glm::translate(glm::dmat4(1.0), dvec3(draws.unit_vector()));
    const glm::dmat4 turned = glm::rotate(moved, draws.uniform(0.0, 6.0), dvec3(draws.unit_vector()));
    const dvec3 scale(draws.uniform(0.5, 2.0), draws.uniform(0.5, 2.0), draws.uniform(0.5, 2.0));
    return glm::scale(turned, mirrored ? -scale : scale);
}

// One emissive triangle in the world, and the same in its object's space.
struct Lamp {
    dvec3 corners_os[3];
    glm::dmat4 world_from_object;
    World world;
};

Lamp random_lamp(Draws& draws, const Material& material, bool mirrored) {
    Lamp lamp;
    std::vector<glm::vec3> corners;
    for (dvec3& corner : lamp.corners_os) {
        corners.push_back(draws.unit_vector());
        corner = corners.back();
    }
    lamp.world_from_object = random_transform(draws, mirrored);
    ToyScene toy;
    toy.add_instance(toy.add_mesh(toy.add_material(material), corners), lamp.world_from_object);
    lamp.world = build_world(toy.scene);
    return lamp;
}

// Volume of the parallelepiped of the triangle's edges and the way to the point, all in the object's space,
// where its front is what it is whatever the transform.
double height_over_front(const Lamp& lamp, const dvec3& point_ws) {
    const dvec3 point_os(glm::inverse(lamp.world_from_object) * glm::dvec4(point_ws, 1.0));
    const dvec3* c = lamp.corners_os;
    return glm::dot(glm::cross(c[1] - c[0], c[2] - c[0]), point_os - c[0]);
}

// Points around random lamps where the light shines on the wrong side, or the surface of a ray that meets it
// there does.
int count_wrong_sides(bool mirrored, bool double_sided) {
    Draws draws(1);
    Material material = emissive_material(glm::vec3(1.0f));
    material.double_sided = double_sided;
    int wrong = 0;
    for (int i = 0; i < 300; ++i) {
        const Lamp lamp = random_lamp(draws, material, mirrored);
        SceneAccess access(lamp.world);
        for (int k = 0; k < 10; ++k) {
            const glm::vec3 point = draws.unit_vector() * 3.0f;
            const double height = height_over_front(lamp, dvec3(point) + lamp.world.origin_ws);
            if (std::abs(height) < 1e-3) continue;
            const bool lit = double_sided || height > 0.0;
            LightSample sample{};
            sample.light = 0;
            sample.uv = glm::vec2(0.3f, 0.2f);
            const IncidentLight incident = access.load_incident_light(sample, point);
            wrong += (incident.value.x > 0.0f) != lit;
            if (lit) wrong += glm::dot(incident.light_normal, incident.direction) >= 0.0f;
            const glm::vec3 place = triangle_point(access.load_light(0), sample.uv);
            const Surface met = access.evaluate_surface(0, 0, sample.uv, glm::normalize(place - point));
            wrong += (met.emission.x > 0.0f) != lit;
        }
    }
    return wrong;
}

TEST(LightSources, ATriangleShinesWhereTheFrontOfItsObjectIsMirroredOrNot) {
    for (const bool mirrored : {false, true}) {
        EXPECT_EQ(count_wrong_sides(mirrored, false), 0) << mirrored;
        EXPECT_EQ(count_wrong_sides(mirrored, true), 0) << mirrored;
    }
}

TEST(LightSources, ALightsPlaceIsThatOfItsTriangle) {
    Draws draws(2);
    for (int i = 0; i < 100; ++i) {
        const Lamp lamp = random_lamp(draws, emissive_material(glm::vec3(1.0f)), i % 2 == 1);
        SceneAccess access(lamp.world);
        const glm::vec2 b = sample_triangle(draws.uniform_vec2());
        const dvec3 place_os = lamp.corners_os[0] * (1.0 - double(b.x) - double(b.y)) +
                               lamp.corners_os[1] * double(b.x) + lamp.corners_os[2] * double(b.y);
        const dvec3 place_ws(lamp.world_from_object * glm::dvec4(place_os, 1.0));
        const dvec3 shipped = dvec3(triangle_point(access.load_light(0), b)) + lamp.world.origin_ws;
        EXPECT_LT(glm::distance(shipped, place_ws), 1e-5);
    }
}

// Shadow rays end before the light by this much; a hit on the same triangle has the same bound.
TEST(LightSources, ALightKnowsHowWrongItsPlaceMayBe) {
    Draws draws(4);
    for (int i = 0; i < 100; ++i) {
        const Lamp lamp = random_lamp(draws, emissive_material(glm::vec3(1.0f)), i % 2 == 1);
        SceneAccess access(lamp.world);
        LightSample sample{};
        sample.light = 0;
        sample.uv = sample_triangle(draws.uniform_vec2());
        const float met = access.evaluate_surface(0, 0, sample.uv, glm::vec3(0, 0, 1)).point.position_error;
        EXPECT_GT(met, 0.0f);
        EXPECT_GE(access.load_light_error(sample), met);
        EXPECT_LE(access.load_light_error(sample), met * 1.0001f);
    }
}

// A Lambertian emitter sends pi * area * radiance from each of its sides, a point 4 pi * intensity.
TEST(LightSources, PowerIsRadianceTimesAreaTimesPiForEachSide) {
    Draws draws(3);
    for (int i = 0; i < 100; ++i) {
        Material material = emissive_material({1.0f, 2.0f, 3.0f});
        material.double_sided = i % 2 == 1;
        const Lamp lamp = random_lamp(draws, material, i % 4 >= 2);
        dvec3 corners_ws[3];
        for (int c = 0; c < 3; ++c) {
            corners_ws[c] = dvec3(lamp.world_from_object * glm::dvec4(lamp.corners_os[c], 1.0));
        }
        const dvec3 cross = glm::cross(corners_ws[1] - corners_ws[0], corners_ws[2] - corners_ws[0]);
        const double luminance = 0.2126 * 1.0 + 0.7152 * 2.0 + 0.0722 * 3.0;
        const double expected = M_PI * 0.5 * glm::length(cross) * luminance * (i % 2 == 1 ? 2.0 : 1.0);
        ASSERT_EQ(lamp.world.lights.powers.size(), 1u);
        EXPECT_NEAR(lamp.world.lights.powers[0], expected, 1e-4 * expected);
    }
    ToyScene toy;
    toy.add_light(PunctualLight{}, glm::dmat4(1.0));
    EXPECT_NEAR(build_world(toy.scene).lights.powers.at(0), 4.0 * M_PI, 1e-5);
}

}  // namespace
}  // namespace tarn
