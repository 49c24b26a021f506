// Triangles drawn evenly over their solid angle: against closed forms and against draws over their area.
#include <gtest/gtest.h>

#include "shared/math/spherical_triangle.h"
#include "support/draws.h"

namespace tarn {
namespace {

using namespace test;

// Van Oosterom and Strackee, "The Solid Angle of a Plane Triangle", 1983, in double precision.
double solid_angle_of(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
    const double la = glm::length(a), lb = glm::length(b), lc = glm::length(c);
    const double upper = std::abs(glm::dot(a, glm::cross(b, c)));
    const double lower = la * lb * lc + glm::dot(a, b) * lc + glm::dot(b, c) * la + glm::dot(c, a) * lb;
    return 2.0 * std::atan2(upper, lower);
}

vec3 draw_corner(Draws& draws) {
    return vec3(float(draws.uniform(-1.0, 1.0)), float(draws.uniform(-1.0, 1.0)),
                float(draws.uniform(0.1, 1.0)));
}

TEST(SphericalTriangle, HasTheSolidAngleOfTheClosedForm) {
    const SphericalTriangle octant = make_spherical_triangle(vec3(2, 0, 0), vec3(0, 3, 0), vec3(0, 0, 0.5f));
    EXPECT_NEAR(octant.solid_angle, M_PI / 2.0, 1e-5);
    Draws draws(1);
    for (int i = 0; i < 1000; ++i) {
        const vec3 a = draw_corner(draws), b = draw_corner(draws), c = draw_corner(draws);
        EXPECT_NEAR(make_spherical_triangle(a, b, c).solid_angle, solid_angle_of(a, b, c), 2e-4);
    }
}

TEST(SphericalTriangle, OneThatTouchesThePlaceIsNone) {
    EXPECT_EQ(make_spherical_triangle(vec3(0.0f), vec3(1, 0, 0), vec3(0, 1, 0)).solid_angle, 0.0f);
}

// The mean of a function over draws by solid angle is its integral over the area, |cosine| / distance^2
// included.
TEST(SphericalTriangle, DrawsAreEvenOverTheSolidAngle) {
    Draws draws(2);
    for (int i = 0; i < 40; ++i) {
        const vec3 a = draw_corner(draws), e1 = draw_corner(draws) - a, e2 = draw_corner(draws) - a;
        const SphericalTriangle t = make_spherical_triangle(a, a + e1, a + e2);
        if (t.solid_angle < 0.02f) continue;
        const auto probe = [](const vec3& d) { return double(d.x * d.x + d.y + 2.0f * d.z * d.y); };
        double drawn = 0.0, expected = 0.0, area = 0.0;
        constexpr int STEPS = 160;
        for (int x = 0; x < STEPS; ++x) {
            for (int y = 0; y < STEPS; ++y) {
                const vec2 u((float(x) + 0.5f) / STEPS, (float(y) + 0.5f) / STEPS);
                const vec2 uv = find_barycentrics(sample_spherical_triangle(t, u), a, e1, e2);
                EXPECT_GE(std::min(uv.x, uv.y), 0.0f);
                EXPECT_LE(uv.x + uv.y, 1.0f + 1e-6f);
                drawn += probe(normalize(a + e1 * uv.x + e2 * uv.y)) / (STEPS * STEPS);
                const vec2 even = sample_triangle(u);
                const vec3 p = a + e1 * even.x + e2 * even.y;
                const double weight = std::abs(dot(cross(e1, e2), normalize(p))) / dot(p, p);
                expected += probe(normalize(p)) * weight;
                area += weight;
            }
        }
        EXPECT_NEAR(drawn, expected / area, 5e-3) << "triangle " << i;
    }
}

}  // namespace
}  // namespace tarn
