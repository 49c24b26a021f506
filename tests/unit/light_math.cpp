// Lights: triangles against closed forms of solid angle and form factor, punctual lights against
// hand-computed values.
#include "shared/math/light.h"

#include <gtest/gtest.h>

#include "shared/interface/light_tiles.h"
#include "shared/math/warp.h"
#include "support/draws.h"

namespace tarn {
namespace {

using glm::dvec3;
using test::Draws;

Light make_triangle(const vec3& a, const vec3& b, const vec3& c, uint flags = LIGHT_TRIANGLE) {
    Light light{};
    light.position = a;
    light.edge1 = b - a;
    light.edge2 = c - a;
    light.flags = flags;
    light.radiance = vec3(1.0f);
    return light;
}

Light make_punctual(uint kind, const vec3& position, const vec3& intensity, float range = 0.0f) {
    Light light{};
    light.flags = kind;
    light.position = position;
    light.radiance = intensity;
    light.range = range;
    return light;
}

// KHR_lights_punctual's two numbers of a spot light, from its cone angles.
void set_cones(Light& light, const vec3& direction, double inner_rad, double outer_rad) {
    const double scale = 1.0 / std::max(0.001, std::cos(inner_rad) - std::cos(outer_rad));
    light.edge1 = direction;
    light.edge2 = vec3(float(scale), float(-std::cos(outer_rad) * scale), 0.0f);
}

// Integral of g(incident) over the triangle's area, by the midpoint rule over congruent small triangles.
template <class G>
double integrate_triangle(const Light& light, const vec3& point, const G& g) {
    constexpr int SIDE = 200;
    double sum = 0.0;
    for (int row = 0; row < SIDE; ++row) {
        for (int column = 0; column < SIDE - row; ++column) {
            const auto add = [&](double offset) {
                const vec2 b(float((column + offset) / SIDE), float((row + offset) / SIDE));
                sum += g(incident_from_triangle(light, b, light.radiance, point));
            };
            add(1.0 / 3.0);
            if (column < SIDE - row - 1) add(2.0 / 3.0);
        }
    }
    return sum * triangle_area(light) / (SIDE * SIDE);
}

// Van Oosterom and Strackee, "The Solid Angle of a Plane Triangle", 1983.
double solid_angle(const Light& light, const vec3& point) {
    const dvec3 a = dvec3(light.position) - dvec3(point);
    const dvec3 b = a + dvec3(light.edge1);
    const dvec3 c = a + dvec3(light.edge2);
    const double la = glm::length(a), lb = glm::length(b), lc = glm::length(c);
    const double numerator = std::abs(glm::dot(a, glm::cross(b, c)));
    return 2.0 * std::atan2(numerator,
                            la * lb * lc + glm::dot(a, b) * lc + glm::dot(a, c) * lb + glm::dot(b, c) * la);
}

// ---- Triangles
// ----------------------------------------------------------------------------------------------------

TEST(TriangleLight, IntegratesToTheSolidAngleOfTheTriangle) {
    Draws draws(1);
    for (int i = 0; i < 20; ++i) {
        const Light light = make_triangle(draws.unit_vector(), draws.unit_vector(), draws.unit_vector(),
                                          LIGHT_TRIANGLE | LIGHT_DOUBLE_SIDED);
        const vec3 point = draws.unit_vector() * 3.0f;
        const double sum =
            integrate_triangle(light, point, [](const IncidentLight& in) { return in.value.x; });
        EXPECT_NEAR(sum, solid_angle(light, point), 2e-5 * (sum + 1e-3));
    }
}

TEST(TriangleLight, TwoMakeTheFormFactorOfARectangle) {
    // A patch below the corner of a parallel a x b rectangle at distance c (Howell's catalogue, B-3).
    const double a = 1.5, b = 0.7, c = 0.9;
    const double x = a / c, y = b / c;
    const double root_x = std::sqrt(1.0 + x * x), root_y = std::sqrt(1.0 + y * y);
    const double form_factor =
        (x / root_x * std::atan(y / root_x) + y / root_y * std::atan(x / root_y)) / (2.0 * M_PI);
    const float fa = float(a), fb = float(b), fc = float(c);
    const vec3 corners[4] = {{0, 0, fc}, {0, fb, fc}, {fa, fb, fc}, {fa, 0, fc}};  // faces down
    const auto cosine_times_value = [](const IncidentLight& in) { return in.value.x * in.direction.z; };
    const double irradiance =
        integrate_triangle(make_triangle(corners[0], corners[1], corners[2]), vec3(0.0f),
                           cosine_times_value) +
        integrate_triangle(make_triangle(corners[0], corners[2], corners[3]), vec3(0.0f), cosine_times_value);
    EXPECT_NEAR(irradiance, M_PI * form_factor, 1e-4 * M_PI * form_factor);
}

TEST(TriangleLight, SeenFromInFrontAtAUnitDistanceSendsItsRadiance) {
    const Light light = make_triangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0});  // faces +Z
    const IncidentLight in = incident_from_triangle(light, vec2(0.0f), vec3(2.0f, 3.0f, 4.0f), vec3(0, 0, 1));
    EXPECT_EQ(in.direction, vec3(0, 0, -1));
    EXPECT_EQ(in.distance, 1.0f);
    EXPECT_EQ(in.value, vec3(2.0f, 3.0f, 4.0f));
    EXPECT_EQ(in.light_normal, vec3(0, 0, 1));
    EXPECT_EQ(triangle_area(light), 0.5f);
}

TEST(TriangleLight, SendsNothingBehindUnlessItIsDoubleSided) {
    Light light = make_triangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0});
    EXPECT_EQ(incident_from_triangle(light, vec2(0.2f), vec3(1.0f), vec3(0.1f, 0.1f, -1.0f)).value,
              vec3(0.0f));
    light.flags |= LIGHT_DOUBLE_SIDED;
    const IncidentLight in = incident_from_triangle(light, vec2(0.0f), vec3(1.0f), vec3(0, 0, -2));
    EXPECT_EQ(in.value, vec3(0.25f));
    EXPECT_EQ(in.light_normal, vec3(0, 0, -1)) << "the normal is on the side of the point";
    EXPECT_EQ(in.direction, vec3(0, 0, 1));
}

TEST(TriangleLight, OfAMirroredInstanceShinesToTheOtherSideOfItsWinding) {
    const Light light = make_triangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, LIGHT_TRIANGLE | LIGHT_MIRRORED);
    EXPECT_EQ(incident_from_triangle(light, vec2(0.0f), vec3(1.0f), vec3(0, 0, 2)).value, vec3(0.0f));
    const IncidentLight in = incident_from_triangle(light, vec2(0.0f), vec3(1.0f), vec3(0, 0, -2));
    EXPECT_EQ(in.value, vec3(0.25f));
    EXPECT_EQ(in.light_normal, vec3(0, 0, -1));
}

TEST(TriangleLight, SendsNothingEdgeOn) {
    for (const uint flags : {LIGHT_TRIANGLE, LIGHT_TRIANGLE | LIGHT_DOUBLE_SIDED}) {
        const Light light = make_triangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, flags);
        EXPECT_EQ(incident_from_triangle(light, vec2(0.25f), vec3(1.0f), vec3(5, 5, 0)).value, vec3(0.0f));
    }
}

TEST(TriangleLight, SendsNothingWithoutAreaOrWhereItTouchesThePoint) {
    const Light line = make_triangle({0, 0, 0}, {1, 0, 0}, {2, 0, 0});
    EXPECT_EQ(incident_from_triangle(line, vec2(0.25f), vec3(1.0f), vec3(0, 0, 1)).value, vec3(0.0f));
    const Light dot = make_triangle({1, 1, 1}, {1, 1, 1}, {1, 1, 1});
    EXPECT_EQ(incident_from_triangle(dot, vec2(0.25f), vec3(1.0f), vec3(0, 0, 1)).value, vec3(0.0f));
    const Light light = make_triangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0});
    const IncidentLight touching =
        incident_from_triangle(light, vec2(0.25f), vec3(1.0f), vec3(0.25f, 0.25f, 0));
    EXPECT_EQ(touching.value, vec3(0.0f));
    EXPECT_TRUE(is_finite3(touching.direction));
}

TEST(TriangleLight, BarycentricsWeighTheSecondAndThirdVertex) {
    const Light light = make_triangle({1, 2, 3}, {4, 2, 3}, {1, 8, 3});
    EXPECT_EQ(triangle_point(light, vec2(0, 0)), vec3(1, 2, 3));
    EXPECT_EQ(triangle_point(light, vec2(1, 0)), vec3(4, 2, 3));
    EXPECT_EQ(triangle_point(light, vec2(0, 1)), vec3(1, 8, 3));
}

// ---- Punctual lights: expected values computed by hand from KHR_lights_punctual
// ---------------------------------------

TEST(PointLight, FallsOffWithTheSquareOfTheDistance) {
    const Light light = make_punctual(LIGHT_POINT, {1, 2, 3}, {8, 4, 2});
    const IncidentLight in = incident_from_punctual(light, vec3(1, 2, 1));
    EXPECT_EQ(in.direction, vec3(0, 0, 1));
    EXPECT_EQ(in.distance, 2.0f);
    EXPECT_EQ(in.value, vec3(2, 1, 0.5f));
    EXPECT_EQ(in.light_normal, vec3(0.0f));
}

TEST(PointLight, ARangeBringsTheLightSmoothlyToNothing) {
    EXPECT_FLOAT_EQ(punctual_falloff(2.0f, 0.0f), 0.25f);
    EXPECT_FLOAT_EQ(punctual_falloff(2.0f, 4.0f), 0.25f * (1.0f - 1.0f / 16.0f));
    EXPECT_FLOAT_EQ(punctual_falloff(3.0f, 4.0f), (1.0f - 81.0f / 256.0f) / 9.0f);
    EXPECT_EQ(punctual_falloff(4.0f, 4.0f), 0.0f);
    EXPECT_EQ(punctual_falloff(100.0f, 4.0f), 0.0f);
}

TEST(PointLight, TouchingThePointSendsNothing) {
    const Light light = make_punctual(LIGHT_POINT, {1, 2, 3}, {8, 4, 2});
    EXPECT_EQ(incident_from_punctual(light, vec3(1, 2, 3)).value, vec3(0.0f));
}

TEST(SpotLight, IsFullInsideTheInnerConeAndDarkOutsideTheOuter) {
    Light light = make_punctual(LIGHT_SPOT, vec3(0.0f), vec3(1.0f));
    set_cones(light, vec3(0, 0, -1), 0.0, M_PI / 4.0);  // the extension's defaults
    EXPECT_FLOAT_EQ(incident_from_punctual(light, vec3(0, 0, -2)).value.x, 0.25f);
    // 30 degrees off: ((cos 30 - cos 45) / (1 - cos 45))^2 = 0.5425821^2 = 0.2943953.
    const vec3 off_axis(0.5f, 0.0f, -0.8660254f);
    EXPECT_NEAR(incident_from_punctual(light, off_axis).value.x, 0.2943953f, 2e-6f);
    EXPECT_EQ(incident_from_punctual(light, vec3(0.7073f, 0.0f, -0.7069f)).value.x, 0.0f);
    EXPECT_EQ(incident_from_punctual(light, vec3(0, 0, 1)).value.x, 0.0f) << "behind the lamp";
    set_cones(light, vec3(0, 0, -1), M_PI / 5.0, M_PI / 4.0);
    EXPECT_NEAR(incident_from_punctual(light, off_axis).value.x, 1.0f, 1e-6f) << "inside the inner cone";
}

TEST(SpotLight, RangeAndConeMultiply) {
    Light light = make_punctual(LIGHT_SPOT, vec3(0.0f), vec3(10.0f), 4.0f);
    set_cones(light, vec3(0, 0, -1), 0.0, M_PI / 4.0);
    EXPECT_FLOAT_EQ(incident_from_punctual(light, vec3(0, 0, -2)).value.x, 10.0f * 0.25f * 15.0f / 16.0f);
}

TEST(DirectionalLight, IsTheSameEverywhereAndComesFromAgainstItsTravel) {
    Light light = make_punctual(LIGHT_DIRECTIONAL, vec3(0.0f), vec3(3.0f));
    light.edge1 = vec3(0, -1, 0);
    for (const vec3 point : {vec3(0.0f), vec3(1e6f, -5.0f, 3.0f)}) {
        const IncidentLight in = incident_from_punctual(light, point);
        EXPECT_EQ(in.direction, vec3(0, 1, 0));
        EXPECT_EQ(in.distance, RAY_INFINITY);
        EXPECT_EQ(in.value, vec3(3.0f));
    }
}

TEST(LightRecord, RoundTripKeepsEveryBitAndTheErrorAsABound) {
    Draws draws(2);
    for (int i = 0; i < 100; ++i) {
        Light light;
        light.position = draws.unit_vector();
        light.flags = draws.bits() & LIGHT_FLAG_BITS;
        light.position_error = 1e-5f * draws.uniform_float();
        light.edge1 = draws.unit_vector();
        light.instance = draws.bits();
        light.edge2 = draws.unit_vector();
        light.primitive = draws.bits();
        light.radiance = draws.uniform_vec3();
        light.range = draws.uniform_float();
        uvec4 rows[LIGHT_ROWS];
        pack_light(light, rows[0], rows[1], rows[2], rows[3]);
        const Light back = unpack_light(rows[0], rows[1], rows[2], rows[3]);
        EXPECT_EQ(back.position, light.position);
        EXPECT_EQ(back.flags, light.flags);
        EXPECT_GE(back.position_error, light.position_error);
        EXPECT_LE(back.position_error, light.position_error * (1.0f + 1e-4f));
        EXPECT_EQ(back.edge1, light.edge1);
        EXPECT_EQ(back.instance, light.instance);
        EXPECT_EQ(back.edge2, light.edge2);
        EXPECT_EQ(back.primitive, light.primitive);
        EXPECT_EQ(back.radiance, light.radiance);
        EXPECT_EQ(back.range, light.range);
    }
}

// A light of every kind, anew for each `i`.
Light make_any(Draws& draws, int i) {
    const vec3 position = draws.unit_vector(), colour = draws.uniform_vec3();
    if (i % 7 < 4) {
        const uint flags =
            LIGHT_TRIANGLE | (i % 2 == 0 ? LIGHT_DOUBLE_SIDED : 0u) | (i % 4 < 2 ? LIGHT_MIRRORED : 0u);
        Light light = make_triangle(position, draws.unit_vector(), draws.unit_vector(), flags);
        light.radiance = colour;
        return light;
    }
    const uint kind = i % 7 == 4 ? LIGHT_POINT : i % 7 == 5 ? LIGHT_SPOT : LIGHT_DIRECTIONAL;
    Light light = make_punctual(kind, position, colour, i % 2 == 0 ? 4.0f : 0.0f);
    set_cones(light, draws.unit_vector(), 0.2, 2.5);
    return light;
}

TEST(LightTiles, ASampleSendsWhatItsLightSends) {
    Draws draws(9);
    int lit = 0;
    for (int i = 0; i < 2000; ++i) {
        const Light light = make_any(draws, i);
        const bool triangle = (light.flags & LIGHT_KIND_MASK) == LIGHT_TRIANGLE;
        LightSample drawn;
        drawn.light = uint(i);
        drawn.uv = triangle ? sample_triangle(draws.uniform_vec2()) : vec2(0.0f);
        const vec3 radiance = draws.uniform_vec3(), point = draws.unit_vector() * 3.0f;
        uvec4 rows[LIGHT_TILE_ROWS];
        pack_light_tile_sample(make_light_tile_sample(light, drawn, 0.25f, radiance), rows[0], rows[1],
                               rows[2], rows[3]);
        const LightTileSample s = unpack_light_tile_sample(rows[0], rows[1], rows[2], rows[3]);
        EXPECT_EQ(s.is_triangle, triangle);
        EXPECT_EQ(s.drawn.light, drawn.light);
        EXPECT_EQ(s.drawn.uv, drawn.uv);
        EXPECT_EQ(s.pdf, 0.25f);
        const IncidentLight found = incident_from_tile_sample(s, triangle, point);
        const IncidentLight expected = triangle ? incident_from_triangle(light, drawn.uv, radiance, point)
                                                : incident_from_punctual(light, point);
        EXPECT_EQ(found.value, expected.value) << i;
        EXPECT_EQ(found.direction, expected.direction) << i;
        EXPECT_EQ(found.distance, expected.distance) << i;
        EXPECT_EQ(found.light_normal, expected.light_normal) << i;
        lit += expected.value.x > 0.0f;
    }
    EXPECT_GT(lit, 1000);
}

TEST(LightRecord, LightsWithoutASurfaceHaveNoError) {
    const Light light = make_punctual(LIGHT_POINT, {1, 2, 3}, {8, 4, 2});
    uvec4 rows[LIGHT_ROWS];
    pack_light(light, rows[0], rows[1], rows[2], rows[3]);
    EXPECT_EQ(unpack_light_error(rows[0]), 0.0f);
}

}  // namespace
}  // namespace tarn
