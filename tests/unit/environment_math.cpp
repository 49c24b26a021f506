// The environment map: directions and texels are each other's inverse, solid angles add up, sampling is
// uniform.
#include "shared/math/environment.h"

#include <gtest/gtest.h>

#include "core/statistics.h"
#include "support/draws.h"
#include "support/histogram.h"

namespace tarn {
namespace {

using test::Draws;
using test::Histogram;
using test::SIGNIFICANCE;

TEST(Environment, UvOfTheAxesIsWhereTheFormatSays) {
    EXPECT_EQ(environment_uv(vec3(0, 0, -1)), vec2(0.5f, 0.5f));
    EXPECT_NEAR(environment_uv(vec3(1, 0, 0)).x, 0.75f, 1e-6f);
    EXPECT_NEAR(environment_uv(vec3(-1, 0, 0)).x, 0.25f, 1e-6f);
    const float seam = environment_uv(vec3(0, 0, 1)).x;
    EXPECT_NEAR(std::min(seam, 1.0f - seam), 0.0f, 1e-6f);
    EXPECT_EQ(environment_uv(vec3(0, 1, 0)).y, 0.0f);
    EXPECT_NEAR(environment_uv(vec3(0, -1, 0)).y, 1.0f, 1e-6f);
}

TEST(Environment, UvIsFiniteAndInTheSquareForAllDirectionsPolesAndSeamIncluded) {
    Draws draws(1);
    for (int i = 0; i < 10'000; ++i) {
        vec3 d = draws.unit_vector();
        if (i % 4 == 1) d = vec3(0.0f, d.y < 0.0f ? -1.0f : 1.0f, -0.0f);
        if (i % 4 == 2) d = vec3(d.x * 1e-20f, d.y < 0.0f ? -1.0f : 1.0f, d.z * 1e-20f);
        if (i % 4 == 3) d = vec3(d.x < 0.0f ? -0.0f : 0.0f, 0.0f, 1.0f);
        const vec2 uv = environment_uv(d);
        EXPECT_GE(uv.x, -1e-6f);
        EXPECT_LE(uv.x, 1.0f + 1e-6f);
        EXPECT_GE(uv.y, 0.0f);
        EXPECT_LE(uv.y, 1.0f + 1e-6f);
    }
}

TEST(Environment, DirectionsOfATexelLieInThatTexel) {
    Draws draws(2);
    for (const uvec2 size : {uvec2(1, 1), uvec2(2, 1), uvec2(7, 5), uvec2(64, 32), uvec2(4096, 2048)}) {
        for (int i = 0; i < 20'000; ++i) {
            const uint column = draws.bits() % size.x;
            // Every second one next to a pole.
            const uint row = i % 4 == 0 ? 0u : i % 4 == 1 ? size.y - 1u : draws.bits() % size.y;
            const vec3 d = environment_direction(column, row, size.x, size.y, draws.uniform_vec2());
            EXPECT_NEAR(length(d), 1.0f, 1e-6f);
            const vec2 uv = environment_uv(d);
            // Rounding may cross an edge by 1e-6 of the map.
            EXPECT_NEAR(uv.x * size.x, column + 0.5, 0.5 + 1e-6 * size.x);
            EXPECT_NEAR(uv.y * size.y, row + 0.5, 0.5 + 1e-6 * size.y);
        }
    }
}

TEST(Environment, DirectionInvertsUvAtRandomPlaces) {
    Draws draws(3);
    for (int i = 0; i < 20'000; ++i) {
        const uint row = draws.bits() % 256u;
        const vec2 u = draws.uniform_vec2();
        const vec3 d = environment_direction(draws.bits() % 512u, row, 512u, 256u, u);
        // The height within the row, in double precision, must be u.y of the row's solid angle.
        const double upper = std::cos(M_PI * row / 256.0);
        const double lower = std::cos(M_PI * (row + 1) / 256.0);
        const double angle = double(environment_uv(d).y) * M_PI;
        EXPECT_NEAR((upper - std::cos(angle)) / (upper - lower), u.y, 3e-4);
    }
}

TEST(Environment, SolidAnglesOfAllTexelsAddUpToTheSphere) {
    for (const uvec2 size : {uvec2(1, 1), uvec2(2, 1), uvec2(7, 5), uvec2(512, 256), uvec2(8192, 4096)}) {
        double sum = 0.0;
        for (uint row = 0; row < size.y; ++row)
            sum += environment_texel_solid_angle(row, size.x, size.y) * size.x;
        EXPECT_NEAR(sum, 4.0 * M_PI, 1e-5);
    }
}

TEST(Environment, SolidAngleOfEachTexelIsExactToSixDigitsNextToThePolesToo) {
    for (uint row = 0; row < 4096u; ++row) {
        // cos a - cos b, from the nearer pole, where 1 - cos is 2 sin^2 of the half.
        const double near = std::min(row, 4095u - row);
        const double inner = std::sin(0.5 * M_PI * near / 4096.0);
        const double outer = std::sin(0.5 * M_PI * (near + 1.0) / 4096.0);
        const double expected = 2.0 * (outer * outer - inner * inner) * 2.0 * M_PI / 8192.0;
        EXPECT_NEAR(environment_texel_solid_angle(row, 8192u, 4096u), expected, 1e-6 * expected) << row;
    }
}

// p value of "directions drawn within a texel are uniform in solid angle".
double texel_p_value(uint row, uint height) {
    constexpr uint WIDTH = 32u;
    constexpr uint COLUMN = 5u;
    Draws draws(4);
    Histogram histogram(16, 16);
    const double near = std::min(row, height - 1u - row);
    const auto half_sine2 = [&](double rows) { return std::pow(std::sin(0.5 * M_PI * rows / height), 2.0); };
    for (int i = 0; i < 100'000; ++i) {
        const glm::dvec3 d(environment_direction(COLUMN, row, WIDTH, height, draws.uniform_vec2()));
        const double turn = std::atan2(d.x, -d.z) / (2.0 * M_PI) + 0.5;
        const double from_pole = std::atan2(std::hypot(d.x, d.z), std::abs(d.y));
        const double height_share = (std::pow(std::sin(0.5 * from_pole), 2.0) - half_sine2(near)) /
                                    (half_sine2(near + 1.0) - half_sine2(near));
        histogram.add(turn * WIDTH - COLUMN, height_share);
    }
    return histogram.uniform_p_value();
}

TEST(Environment, SamplingIsUniformInSolidAngleWithinATexelInTheFirstRowsOfALargeMapToo) {
    for (const uint height : {8u, 256u, 4096u}) {
        for (const uint row : {0u, 1u, height / 4u, height - 2u, height - 1u}) {
            EXPECT_GT(texel_p_value(row, height), sidak_threshold(SIGNIFICANCE, 15))
                << row << " of " << height;
        }
    }
}

}  // namespace
}  // namespace tarn
