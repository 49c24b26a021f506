// Glare over images: what it keeps, how far and how evenly it spreads, what it leaves alone.
#include "core/glare.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/display.h"
#include "shared/math/glare.h"
#include "support/draws.h"

namespace tarn {
namespace {

using namespace test;

Image draw_lamp(int width, int height, int x, int y, float level = 200.0f) {
    Image image(width, height, 3);
    for (float& value : image.values) value = 0.01f;
    for (int c = 0; c < 3; ++c) image.pixel(x, y)[c] = level;
    return image;
}

double sum_of(const Image& image) {
    double sum = 0.0;
    for (const float value : image.values) sum += double(value);
    return sum;
}

Image with_glare(Image image, float strength = 1.0f) {
    add_glare_to(image, strength);
    return image;
}

struct Spread {
    double mean_x = 0.0, mean_y = 0.0, variance_x = 0.0, variance_y = 0.0;
};

// Of what has left the lamp's pixel, around the lamp.
Spread measure_spread(const Image& before, const Image& after, int lamp_x, int lamp_y) {
    Spread spread;
    double sum = 0.0;
    for (int y = 0; y < after.height; ++y) {
        for (int x = 0; x < after.width; ++x) {
            if (x == lamp_x && y == lamp_y) continue;
            const double light = double(after.pixel(x, y)[1]) - double(before.pixel(x, y)[1]);
            sum += light;
            spread.mean_x += light * (x - lamp_x);
            spread.mean_y += light * (y - lamp_y);
            spread.variance_x += light * (x - lamp_x) * (x - lamp_x);
            spread.variance_y += light * (y - lamp_y) * (y - lamp_y);
        }
    }
    for (double* moment : {&spread.mean_x, &spread.mean_y, &spread.variance_x, &spread.variance_y})
        *moment /= sum;
    return spread;
}

TEST(Glare, keepsTheLightOfAPictureAtAnySizeAndPlace) {
    for (const auto& [width, height] : {std::pair(64, 64), {37, 91}, {1, 1}, {2, 5}, {320, 180}, {3, 1}}) {
        for (const auto& [u, v] :
             {std::pair(0.5, 0.5), {0.0, 0.0}, {0.999, 0.999}, {0.999, 0.3}, {0.2, 0.999}}) {
            const Image lamp = draw_lamp(width, height, int(u * width), int(v * height));
            EXPECT_NEAR(sum_of(with_glare(lamp)) / sum_of(lamp), 1.0, 1e-5)
                << width << " x " << height << ", " << u << ", " << v;
        }
    }
}

TEST(Glare, aLampLosesWhatTheOctavesGetAndNothingGetsDark) {
    const Image lamp = draw_lamp(256, 256, 100, 120);
    const Image after = with_glare(lamp);
    const int levels = count_glare_levels(256, 256);
    EXPECT_EQ(levels, 6);
    const float lost = lamp.pixel(100, 120)[0] - after.pixel(100, 120)[0];
    // What the narrow pictures leave in its pixel comes back: of the first one 5/8 x 5/8 of a quarter, and so
    // on.
    EXPECT_LT(lost, 199.0f * GLARE_PER_OCTAVE * float(levels));
    EXPECT_GT(lost, 199.0f * GLARE_PER_OCTAVE * (float(levels) - 0.5f));
    for (std::size_t i = 0; i < after.values.size(); ++i) {
        if (lamp.values[i] < 1.0f) {
            EXPECT_GE(after.values[i], lamp.values[i]);
        }
    }
}

// The grid of cells has four kinds of pixels; the centre of what they spread is the lamp for each.
TEST(Glare, spreadsEvenlyAroundALamp) {
    for (const auto& [x, y] : {std::pair(256, 256), {257, 256}, {256, 257}, {259, 262}}) {
        const Image lamp = draw_lamp(512, 512, x, y);
        const Spread spread = measure_spread(lamp, with_glare(lamp), x, y);
        const double deviation = std::sqrt(spread.variance_x);
        EXPECT_NEAR(spread.mean_x / deviation, 0.0, 0.005) << x << ", " << y;
        EXPECT_NEAR(spread.mean_y / deviation, 0.0, 0.005) << x << ", " << y;
        EXPECT_NEAR(spread.variance_x / spread.variance_y, 1.0, 0.02) << x << ", " << y;
    }
}

TEST(Glare, isTheSameInAMirror) {
    Draws draws(3);
    Image image(64, 64, 3), mirrored(64, 64, 3);
    for (int y = 0; y < 64; ++y) {
        for (int x = 0; x < 64; ++x) {
            const float level = std::exp2(float(draws.uniform(-8.0, 6.0)));
            for (int c = 0; c < 3; ++c) image.pixel(x, y)[c] = mirrored.pixel(63 - x, 63 - y)[c] = level;
        }
    }
    image = with_glare(image), mirrored = with_glare(mirrored);
    for (int y = 0; y < 64; ++y) {
        for (int x = 0; x < 64; ++x) {
            EXPECT_NEAR(image.pixel(x, y)[0] / mirrored.pixel(63 - x, 63 - y)[0], 1.0f, 1e-4f);
        }
    }
}

// Equal light in each octave of distance: the light between 4 and 8 pixels is that between 8 and 16.
TEST(Glare, fallsWithTheSquareOfTheDistance) {
    const Image lamp = draw_lamp(512, 512, 256, 256);
    const Image after = with_glare(lamp);
    std::vector<double> rings(7);
    for (int y = 0; y < 512; ++y) {
        for (int x = 0; x < 512; ++x) {
            const double octave = std::log2(std::max(1e-3, std::hypot(x - 256, y - 256)));
            if (octave < 2.0 || octave >= 7.0) continue;
            rings[std::size_t(octave)] += double(after.pixel(x, y)[0]) - double(lamp.pixel(x, y)[0]);
        }
    }
    for (int octave = 2; octave < 6; ++octave) {
        const double part = rings[std::size_t(octave)] / (199.0 * double(GLARE_PER_OCTAVE));
        EXPECT_NEAR(part, 1.0, 0.15) << "octave " << octave;
    }
}

TEST(Glare, leavesAloneWhatIsNoBrighterThanWhite) {
    Draws draws(1);
    Image dim(40, 30, 3);
    for (float& value : dim.values) value = float(draws.uniform());
    EXPECT_EQ(with_glare(dim).values, dim.values);
    Image even(37, 21, 3);
    for (float& value : even.values) value = 5.0f;
    for (const float value : with_glare(even, 8.0f).values) EXPECT_NEAR(value, 5.0f, 1e-4f);
}

TEST(Glare, doesNotSpreadWhatIsNoNumber) {
    Image clean = draw_lamp(64, 48, 30, 20, 4.0f), broken = clean;
    clean.pixel(5, 6)[0] = 0.0f;
    broken.pixel(5, 6)[0] = std::nanf("");
    const Image expected = display_from_radiance(clean, 1.0f, {ToneCurve::NEUTRAL, 1.0f});
    EXPECT_EQ(display_from_radiance(broken, 1.0f, {ToneCurve::NEUTRAL, 1.0f}).values, expected.values);
    broken.pixel(5, 6)[0] = INFINITY;
    for (const float value : display_from_radiance(broken, 1.0f, {ToneCurve::NEUTRAL, 8.0f}).values) {
        EXPECT_TRUE(value >= 0.0f && value <= 1.0f);
    }
}

}  // namespace
}  // namespace tarn
