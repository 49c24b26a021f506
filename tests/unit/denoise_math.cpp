// The denoiser's arithmetic against double precision and plain geometry.
#include "shared/math/denoise.h"

#include <gtest/gtest.h>

#include "support/draws.h"

namespace tarn {
namespace {

using test::Draws;

// A mean and a variance that fade, in double precision and from all values at once.
TEST(LightMoments, AreThoseOfTheWeightedValuesAtAnyScale) {
    for (const double scale : {1e-6, 1.0, 1e6}) {
        Draws draws(3);
        LightMoments moments{0.0f, 0.0f};
        std::vector<double> values, weights;
        for (int i = 1; i <= 100; ++i) {
            const double share = std::max(1.0 / i, 0.1);
            values.push_back(scale * (1000.0 + draws.uniform(-1.0, 1.0)));
            for (double& weight : weights) weight *= 1.0 - share;
            weights.push_back(share);
            moments = add_to_moments(moments, float(values.back()), float(share));
        }
        double mean = 0.0, variance = 0.0;
        for (std::size_t i = 0; i < values.size(); ++i) mean += weights[i] * values[i];
        for (std::size_t i = 0; i < values.size(); ++i)
            variance += weights[i] * std::pow(values[i] - mean, 2.0);
        EXPECT_NEAR(moments.mean / mean, 1.0, 1e-6) << scale;
        EXPECT_NEAR(moments.variance / variance, 1.0, 2e-3) << scale;
    }
}

// m2 - m1^2 in single precision: what the form above is for.
TEST(LightMoments, NegativeControlMeansOfSquaresLoseAllDigits) {
    float first = 0.0f, second = 0.0f;
    Draws draws(3);
    for (int i = 1; i <= 100; ++i) {
        const float share = std::max(1.0f / float(i), 0.1f);
        const float value = 1e6f + float(draws.uniform(-1.0, 1.0));
        first += share * (value - first);
        second += share * (value * value - second);
    }
    EXPECT_GT(std::abs((second - first * first) / 0.33f - 1.0f), 1.0f);
}

CameraRecord make_camera(Draws& draws, bool orthographic) {
    const glm::vec3 forward = draws.unit_vector();
    const glm::vec3 side = glm::normalize(glm::cross(forward, draws.unit_vector()));
    CameraRecord camera;
    camera.position = 10.0f * draws.uniform_vec3();
    camera.forward = forward;
    camera.right = 0.8f * side;
    camera.up = 0.5f * glm::cross(side, forward);
    camera.orthographic = orthographic;
    return camera;
}

TEST(PlaneView, DistancesAreThoseOfThePointsThatPixelsSee) {
    Draws draws(5);
    const glm::vec2 size_px(64.0f, 40.0f), jitter_px(0.3f, -0.2f);
    for (int i = 0; i < 1000; ++i) {
        const CameraRecord camera = make_camera(draws, i % 2 == 0);
        const glm::vec3 normal = draws.unit_vector();
        const glm::vec3 place = camera.position + 3.0f * camera.forward + draws.unit_vector();
        const glm::vec2 pixel(float(draws.bits() % 64u), float(draws.bits() % 40u));
        const float depth = float(draws.uniform(1.0, 5.0));
        const PixelRay ray = camera_ray(camera, pixel + 0.5f + jitter_px, size_px);
        const float along = (depth - glm::dot(ray.origin - camera.position, camera.forward)) /
                            glm::dot(ray.direction, camera.forward);
        const float expected = std::abs(glm::dot(ray.origin + along * ray.direction - place, normal));
        const PlaneView view = make_plane_view(camera, jitter_px, size_px, place, normal);
        EXPECT_NEAR(plane_distance(view, pixel, depth), expected, 2e-5f) << i;
    }
}

TEST(ProjectedNormal, PacksToATenthOfADegreeAndMeasuresAngles) {
    Draws draws(9);
    const CameraRecord camera = make_camera(draws, false);
    for (int i = 0; i < 1000; ++i) {
        glm::vec3 normal = draws.unit_vector();
        if (glm::dot(normal, camera.forward) > 0.0f) normal = -normal;
        const vec2 projected = project_normal(camera, normal);
        EXPECT_NEAR(glm::length(unpack_projected_normal(pack_projected_normal(projected)) - projected), 0.0f,
                    1e-3f);
        const glm::vec3 turned = glm::normalize(normal + 0.05f * draws.unit_vector());
        if (glm::dot(turned, camera.forward) > 0.0f) continue;
        const vec2 difference = project_normal(camera, turned) - projected;
        const float chord = glm::length(turned - normal);
        EXPECT_NEAR(std::sqrt(glm::dot(difference, difference) * chord_factor(projected)), chord,
                    0.06f * chord + 1e-6f);
    }
}

TEST(HistoryTag, ComesBackAsItWas) {
    for (const float instance : {0.0f, 1.0f, 255.0f}) {
        for (const float base : {0.0f, 0.25f, 31.75f, 63.0f}) {
            for (const float layer : {0.0f, 1.5f, 63.0f}) {
                const HistoryTag tag = unpack_history_tag(pack_history_tag({{base, layer}, instance}));
                EXPECT_EQ(tag.frames, vec2(base, layer));
                EXPECT_EQ(tag.instance, instance);
            }
        }
    }
    EXPECT_EQ(unpack_history_tag(pack_history_tag({{1000.0f, -1.0f}, 256.0f + 7.0f})).instance, 7.0f);
}

// All in units of the light: the same decision at any exposure.
TEST(LuminanceDifference, DoesNotKnowTheExposure) {
    for (const float scale : {1e-6f, 1.0f, 1e6f}) {
        const float d = luminance_difference(2.0f * scale, 1.0f * scale, 0.25f * scale * scale, 4.0f);
        EXPECT_NEAR(d, 1.0f, 1e-4f) << scale;
    }
    EXPECT_EQ(luminance_difference(0.0f, 0.0f, 0.0f, 4.0f), 0.0f);
    EXPECT_EQ(fade(0.0f), 1.0f);
    EXPECT_EQ(fade(7.0f), 0.0f);
}

TEST(Outliers, AmongBlackPixelsNothingStandsOut) {
    EXPECT_FALSE(is_outlier(1e6f, 0.0f));
    EXPECT_TRUE(is_outlier(1e6f, 1.0f));
    EXPECT_FALSE(is_outlier(10.0f, 1.0f));
    EXPECT_FALSE(is_usable_light({0.0f, -1.0f, 0.0f}));
    EXPECT_FALSE(is_usable_light({0.0f, std::nanf(""), 0.0f}));
    EXPECT_FALSE(is_usable_light({1e20f, 0.0f, 0.0f}));
}

}  // namespace
}  // namespace tarn
