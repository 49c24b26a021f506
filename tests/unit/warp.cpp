// Warps against their densities by chi-square, frames against orthonormality in double precision.
#include "shared/math/warp.h"

#include <gtest/gtest.h>

#include <functional>

#include "support/draws.h"
#include "support/histogram.h"

namespace tarn {
namespace {

using test::Draws;
using test::Histogram;
using test::SIGNIFICANCE;

constexpr int DRAW_COUNT = 200'000;

double azimuth_share(const vec3& v) {
    return std::atan2(double(v.y), double(v.x)) / (2.0 * M_PI) + 0.5;
}

// z / pi over the hemisphere is uniform in (z^2, azimuth).
double cosine_p_value(const std::function<vec3(vec2)>& warp) {
    Draws draws(1);
    Histogram histogram(24, 24);
    for (int i = 0; i < DRAW_COUNT; ++i) {
        const vec3 d = warp(draws.uniform_vec2());
        histogram.add(double(d.z) * d.z, azimuth_share(d));
    }
    return histogram.uniform_p_value();
}

// The triangle's SIDE^2 congruent small triangles are equally likely.
double triangle_p_value(const std::function<vec2(vec2)>& warp) {
    constexpr int SIDE = 16;
    Draws draws(2);
    std::vector<double> counts(SIDE * SIDE);
    for (int i = 0; i < DRAW_COUNT; ++i) {
        const vec2 b = warp(draws.uniform_vec2());
        const int column = std::min(int(b.x * SIDE), SIDE - 1);
        const int row = std::min(int(b.y * SIDE), SIDE - 1 - column);
        const bool upper = b.x * SIDE - column + (b.y * SIDE - row) > 1.0;
        // Row r has SIDE - r upright triangles and SIDE - r - 1 upside-down ones.
        ++counts[row * (2 * SIDE - row) + 2 * column + (upper ? 1 : 0)];
    }
    const std::vector<double> expected(counts.size(), double(DRAW_COUNT) / double(counts.size()));
    return chi_square_test(counts, expected).p_value;
}

TEST(Warp, CosineHemisphereFollowsItsDensity) {
    EXPECT_GT(cosine_p_value(sample_cosine_hemisphere), SIGNIFICANCE);
}

TEST(Warp, NegativeControlAUniformHemisphereIsNotCosineDistributed) {
    EXPECT_LT(cosine_p_value([](vec2 u) {
                  const float radius = std::sqrt(1.0f - u.x * u.x);
                  return vec3(radius * cos(2.0f * PI * u.y), radius * sin(2.0f * PI * u.y), u.x);
              }),
              SIGNIFICANCE);
}

TEST(Warp, CosineHemisphereIsUnitAndNeverBelowAtTheCornersOfTheSquare) {
    const float last = 1.0f - 0x1p-24f;
    for (const float x : {0.0f, 0.5f, last}) {
        for (const float y : {0.0f, 0.25f, 0.5f, last}) {
            const vec3 d = sample_cosine_hemisphere(vec2(x, y));
            EXPECT_NEAR(length(d), 1.0f, 1e-6f);
            EXPECT_GT(d.z, 0.0f);
        }
    }
}

TEST(Warp, TriangleIsUniformInArea) {
    EXPECT_GT(triangle_p_value(sample_triangle), SIGNIFICANCE);
}

TEST(Warp, NegativeControlScalingByTheRemainderCrowdsOneVertexOfTheTriangle) {
    EXPECT_LT(triangle_p_value([](vec2 u) { return vec2(u.x, u.y * (1.0f - u.x)); }), SIGNIFICANCE);
}

TEST(Warp, TriangleStaysInsideAtTheCornersOfTheSquare) {
    const float last = 1.0f - 0x1p-24f;
    for (const float x : {0.0f, 0.5f, last}) {
        for (const float y : {0.0f, 0.5f, last}) {
            const vec2 b = sample_triangle(vec2(x, y));
            EXPECT_GE(b.x, 0.0f);
            EXPECT_GE(b.y, 0.0f);
            EXPECT_LE(double(b.x) + double(b.y), 1.0);
        }
    }
}

double dot_double(const vec3& a, const vec3& b) {
    return glm::dot(glm::dvec3(a), glm::dvec3(b));
}

// Largest deviation of a frame around `n` from an orthonormal right-handed one.
double frame_error(const vec3& n) {
    const Frame f = make_frame(n);
    double error = std::abs(dot_double(f.tangent, f.tangent) - 1.0);
    error = std::max(error, std::abs(dot_double(f.bitangent, f.bitangent) - 1.0));
    error = std::max(error, std::abs(dot_double(f.tangent, f.bitangent)));
    error = std::max(error, std::abs(dot_double(f.tangent, n)));
    error = std::max(error, std::abs(dot_double(f.bitangent, n)));
    const glm::dvec3 right = glm::cross(glm::dvec3(f.tangent), glm::dvec3(f.bitangent));
    return std::max(error, glm::length(right - glm::dvec3(n)));
}

TEST(Frame, IsOrthonormalAndRightHandedForRandomNormals) {
    Draws draws(3);
    for (int i = 0; i < 100'000; ++i) EXPECT_LT(frame_error(draws.unit_vector()), 1e-6);
}

TEST(Frame, IsOrthonormalAtAndAroundBothPoles) {
    for (const float z : {1.0f, -1.0f}) {
        EXPECT_LT(frame_error(vec3(0.0f, 0.0f, z)), 1e-12);
        EXPECT_LT(frame_error(vec3(-0.0f, 0.0f, z)), 1e-12);
        for (double sine = 1e-30; sine < 0.1; sine *= 3.0) {
            const float cosine = z * float(std::sqrt(1.0 - sine * sine));
            EXPECT_LT(frame_error(vec3(float(sine), 0.0f, cosine)), 1e-6) << sine;
            EXPECT_LT(frame_error(vec3(float(-0.6 * sine), float(0.8 * sine), cosine)), 1e-6) << sine;
        }
    }
}

TEST(Frame, IsOrthonormalOnTheEquatorWithEitherSignOfZero) {
    for (const float z : {0.0f, -0.0f, 1e-30f, -1e-30f}) {
        EXPECT_LT(frame_error(vec3(1.0f, 0.0f, z)), 1e-6);
        EXPECT_LT(frame_error(vec3(0.6f, -0.8f, z)), 1e-6);
    }
}

TEST(Frame, ToLocalUndoesFromLocalAndTheNormalIsZ) {
    Draws draws(4);
    for (int i = 0; i < 1000; ++i) {
        const Frame frame = make_frame(draws.unit_vector());
        const vec3 v = draws.unit_vector();
        EXPECT_LT(length(to_local(frame, from_local(frame, v)) - v), 1e-6f);
        EXPECT_LT(length(to_local(frame, frame.normal) - vec3(0.0f, 0.0f, 1.0f)), 1e-6f);
    }
}

}  // namespace
}  // namespace tarn
