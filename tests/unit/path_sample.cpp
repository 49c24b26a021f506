// Path samples: their packing, and the Jacobian of the reconnection against solid angles of small patches.
#include "shared/math/path_sample.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/gtc/constants.hpp>

#include "shared/math/warp.h"
#include "support/draws.h"

namespace tarn {
namespace {

using namespace test;

// Solid angle of a triangle from the origin (Van Oosterom and Strackee, "The Solid Angle of a Plane
// Triangle", 1983).
double solid_angle(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
    const double la = glm::length(a), lb = glm::length(b), lc = glm::length(c);
    const double numerator = glm::dot(a, glm::cross(b, c));
    const double denominator = la * lb * lc + glm::dot(a, b) * lc + glm::dot(b, c) * la + glm::dot(c, a) * lb;
    return std::abs(2.0 * std::atan2(numerator, denominator));
}

// Of a small triangle about `place`, as `eye` sees it.
double patch_solid_angle(const glm::dvec3& eye, const glm::dvec3& place, const glm::dvec3& normal) {
    const Frame frame = make_frame(vec3(normal));
    const glm::dvec3 t(frame.tangent), b(frame.bitangent);
    const double size = 1e-4;
    const glm::dvec3 centre = place - eye;
    return solid_angle(centre + t * size, centre - t * (0.5 * size) + b * (0.866 * size),
                       centre - t * (0.5 * size) - b * (0.866 * size));
}

TEST(PathSample, TheJacobianIsARatioOfSolidAngles) {
    Draws draws(1);
    int compared = 0;
    for (int i = 0; i < 2000; ++i) {
        const vec3 normal = draws.unit_vector();
        const vec3 place = draws.uniform_vec3() * 4.0f;
        const vec3 from = place + sample_uniform_hemisphere(draws.uniform_vec2()) * 2.0f;
        const vec3 to = place + draws.unit_vector() * (0.5f + 2.0f * draws.uniform_float());
        const float jacobian = reconnection_jacobian(from, to, place, normal);
        const bool both_in_front = dot(normal, from - place) > 0.0f && dot(normal, to - place) > 0.0f;
        if (!both_in_front) {
            EXPECT_EQ(jacobian, 0.0f);
            continue;
        }
        const double expected = patch_solid_angle(to, place, normal) / patch_solid_angle(from, place, normal);
        if (std::abs(std::log(expected)) > std::log(0.99 * MAX_RECONNECTION_JACOBIAN)) {
            // The bound itself lies between these two.
            if (std::abs(std::log(expected)) > std::log(1.01 * MAX_RECONNECTION_JACOBIAN)) {
                EXPECT_EQ(jacobian, 0.0f);
            }
            continue;
        }
        EXPECT_NEAR(jacobian / expected, 1.0, 2e-3);
        ++compared;
    }
    EXPECT_GT(compared, 300);
}

TEST(PathSample, TheBoundIsTheSameBothWays) {
    Draws draws(2);
    int beyond = 0;
    for (int i = 0; i < 20000; ++i) {
        const vec3 normal(0.0f, 0.0f, 1.0f);
        const vec3 from(draws.uniform_vec2(), 0.05f + draws.uniform_float());
        const vec3 to(draws.uniform_vec2(), 0.05f + draws.uniform_float());
        const vec3 place(draws.uniform_vec2(), 0.0f);
        const float there = reconnection_jacobian(from, to, place, normal);
        const float back = reconnection_jacobian(to, from, place, normal);
        EXPECT_EQ(there == 0.0f, back == 0.0f);
        if (there == 0.0f) {
            ++beyond;
        } else {
            EXPECT_NEAR(there * back, 1.0f, 1e-5f);
        }
    }
    EXPECT_GT(beyond, 100);
}

TEST(PathSample, PackingRoundsOnceAndNoMore) {
    Draws draws(3);
    for (int i = 0; i < 1000; ++i) {
        PathSample s = no_path_sample();
        s.instance = std::uint32_t(i);
        s.primitive = std::uint32_t(7 * i) | (i % 2 == 0 ? PATH_BACK_FACE : 0u);
        s.barycentrics = draws.uniform_vec2();
        s.shading_normal = draws.unit_vector();
        s.incident_direction = draws.unit_vector();
        s.incident = draws.uniform_vec3() * float(std::exp2(draws.uniform(-60.0, 60.0)));
        s.material = {draws.uniform_vec3(), draws.uniform_vec3(), draws.uniform_float(),
                      float(draws.uniform(MIN_ALPHA, 1.0))};
        uvec4 rows[PATH_SAMPLE_ROWS];
        pack_path_rows(s, rows[0], rows[1], rows[2]);
        const PathSample once = unpack_path_sample(pack_path_head(s), rows[0], rows[1], rows[2]);
        EXPECT_EQ(once.instance, s.instance);
        EXPECT_EQ(once.primitive, s.primitive);
        EXPECT_EQ(once.barycentrics, s.barycentrics);
        EXPECT_EQ(once.incident, s.incident);
        EXPECT_LT(length(once.shading_normal - s.shading_normal), 1e-4f);
        EXPECT_LT(length(once.incident_direction - s.incident_direction), 1e-4f);
        EXPECT_NEAR(once.material.f90, s.material.f90, 1e-5f);
        EXPECT_NEAR(std::sqrt(once.material.alpha), std::sqrt(s.material.alpha), 1e-5f);
        for (int c = 0; c < 3; ++c) {
            EXPECT_NEAR(once.material.diffuse_albedo[c], s.material.diffuse_albedo[c], 1e-5f);
            EXPECT_NEAR(once.material.f0[c], s.material.f0[c], 1e-5f);
        }
        uvec4 again[PATH_SAMPLE_ROWS];
        pack_path_rows(once, again[0], again[1], again[2]);
        EXPECT_EQ(again[1], rows[1]);
        EXPECT_EQ(again[2], rows[2]);
    }
}

// A frame that reaches all directions evenly, so that the uniform pdf is what it says.
TEST(PathSample, TheUniformHemisphereIsUniform) {
    Draws draws(4);
    constexpr int COUNT = 200000;
    glm::dvec3 sum(0.0);
    double squares = 0.0;
    for (int i = 0; i < COUNT; ++i) {
        const vec3 d = sample_uniform_hemisphere(draws.uniform_vec2());
        EXPECT_NEAR(length(d), 1.0f, 1e-5f);
        EXPECT_GE(d.z, 0.0f);
        sum += glm::dvec3(d);
        squares += double(d.z) * d.z;
    }
    EXPECT_NEAR(sum.z / COUNT, 0.5, 0.004);
    EXPECT_NEAR(squares / COUNT, 1.0 / 3.0, 0.004);
    EXPECT_NEAR(sum.x / COUNT, 0.0, 0.005);
    EXPECT_NEAR(sum.y / COUNT, 0.0, 0.005);
}

}  // namespace
}  // namespace tarn
