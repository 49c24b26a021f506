// The display transform against hand-computed values of its published formulas.
#include "core/display.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/error.h"
#include "shared/math/display.h"

namespace tarn {
namespace {

constexpr float INFINITE = std::numeric_limits<float>::infinity();

Image constant(float r, float g, float b, int width = 1, int height = 1) {
    Image image(width, height, 3);
    for (std::size_t i = 0; i < image.values.size(); i += 3) {
        image.values[i] = r;
        image.values[i + 1] = g;
        image.values[i + 2] = b;
    }
    return image;
}

TEST(Srgb, matches_the_standard_and_its_inverse) {
    EXPECT_FLOAT_EQ(encode_srgb(0.002f), 0.02584f);
    EXPECT_NEAR(encode_srgb(0.18f), 0.461356f, 1e-6);
    EXPECT_NEAR(encode_srgb(1.0f), 1.0f, 1e-6);
    for (int i = 0; i <= 255; ++i)
        EXPECT_NEAR(encode_srgb(decode_srgb(float(i) / 255.0f)), float(i) / 255.0f, 1e-6);
}

TEST(ToneMapNeutral, takes_off_the_glare_and_compresses_highlights) {
    const vec3 dark = map_tone_neutral(vec3(0.05f));  // 6.25 * 0.05^2
    EXPECT_NEAR(dark[1], 0.015625f, 1e-6);
    const vec3 middle = map_tone_neutral(vec3(0.5f, 0.3f, 0.1f));  // less 0.04
    EXPECT_NEAR(middle[0], 0.46f, 1e-6);
    EXPECT_NEAR(middle[2], 0.06f, 1e-6);
    const vec3 grey = map_tone_neutral(vec3(4.0f));  // 1 - 0.24^2 / 3.44
    EXPECT_NEAR(grey[0], 0.983256f, 1e-6);
    // Peak 1.96 becomes 0.96, the others scale with it, then move to it by 1 - 1 / 1.15.
    const vec3 colour = map_tone_neutral(vec3(2.0f, 1.0f, 0.5f));
    EXPECT_NEAR(colour[0], 0.96f, 1e-6);
    EXPECT_NEAR(colour[1], 0.534090f, 1e-5);
    EXPECT_NEAR(colour[2], 0.321136f, 1e-5);
}

TEST(DisplayFromRadiance, exposes_maps_and_encodes) {
    const Image display = display_from_radiance(constant(0.25f, 0.25f, 0.25f), 1.0f);
    EXPECT_NEAR(display.values[0], encode_srgb(0.46f), 1e-6);
}

TEST(DisplayFromRadiance, stays_in_range_for_any_input) {
    const float extremes[] = {-1.0f, 0.0f, 1e-40f, 1e30f, 3e38f, INFINITE, -INFINITE, std::nanf("")};
    for (const float r : extremes) {
        for (const float g : extremes) {
            const Image display = display_from_radiance(constant(r, g, 0.5f), 20.0f);
            for (const float value : display.values)
                EXPECT_TRUE(value >= 0.0f && value <= 1.0f) << r << ' ' << g;
        }
    }
    EXPECT_EQ(display_from_radiance(constant(std::nanf(""), 0, 0), 0.0f).values[0], 0.0f);
    EXPECT_NEAR(display_from_radiance(constant(INFINITE, INFINITE, INFINITE), 0.0f).values[0], 1.0f, 1e-3);
}

TEST(ToneClip, cuts_each_channel_off_at_white_and_changes_nothing_below) {
    const Image display = display_from_radiance(constant(0.25f, 4.0f, 0.5f), 0.0f, {ToneCurve::CLIP});
    EXPECT_NEAR(display.values[0], encode_srgb(0.25f), 1e-6);
    EXPECT_EQ(display.values[1], 1.0f);
    EXPECT_NEAR(display.values[2], encode_srgb(0.5f), 1e-6);
    EXPECT_EQ(parse_tone_curve("clip"), ToneCurve::CLIP);
    EXPECT_EQ(parse_tone_curve("neutral"), ToneCurve::NEUTRAL);
    EXPECT_THROW(parse_tone_curve("filmic"), Error);
}

// The published curve's promise: up to 0.8 a colour only loses 0.04 of each channel, so hues stay.
TEST(ToneMapNeutral, keeps_the_order_of_channels_and_never_leaves_the_range) {
    for (float level = 0.01f; level < 1e6f; level *= 1.7f) {
        const vec3 mapped = map_tone_neutral(level * vec3(1.0f, 0.6f, 0.2f));
        EXPECT_GE(mapped[0], mapped[1]) << level;
        EXPECT_GE(mapped[1], mapped[2]) << level;
        EXPECT_LT(mapped[0], 1.0f + 1e-6f) << level;
        EXPECT_GE(mapped[2], 0.0f) << level;
    }
}

TEST(MeasuringExposure, maps_the_log_average_to_middle_grey) {
    EXPECT_NEAR(measuring_exposure_ev(constant(0.18f, 0.18f, 0.18f)), 0.0f, 1e-5);
    EXPECT_NEAR(measuring_exposure_ev(constant(0.09f, 0.09f, 0.09f, 8, 8)), 1.0f, 1e-5);
    Image two = constant(0.18f, 0.18f, 0.18f, 2, 1);
    for (int c = 0; c < 3; ++c) two.pixel(1, 0)[c] = 0.18f * 16.0f;
    EXPECT_NEAR(measuring_exposure_ev(two), -2.0f, 1e-5);
}

TEST(MeasuringExposure, ignores_extremes_black_and_non_finite_pixels) {
    Image image = constant(0.18f, 0.18f, 0.18f, 20, 10);
    for (int c = 0; c < 3; ++c) {
        image.pixel(0, 0)[c] = 1e20f;
        image.pixel(1, 0)[c] = 1e-20f;
        image.pixel(2, 0)[c] = 0.0f;
        image.pixel(3, 0)[c] = std::nanf("");
        image.pixel(4, 0)[c] = INFINITE;
    }
    EXPECT_NEAR(measuring_exposure_ev(image), 0.0f, 1e-5);
}

TEST(MeasuringExposure, is_limited_and_zero_where_nothing_counts) {
    EXPECT_EQ(measuring_exposure_ev(constant(1e-20f, 1e-20f, 1e-20f)), 20.0f);
    EXPECT_EQ(measuring_exposure_ev(constant(1e20f, 1e20f, 1e20f)), -20.0f);
    EXPECT_EQ(measuring_exposure_ev(constant(0.0f, 0.0f, 0.0f)), 0.0f);
}

}  // namespace
}  // namespace tarn
