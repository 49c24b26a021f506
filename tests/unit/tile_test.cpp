// The tile test is right as often as it says on Gaussian, skewed and blotchy noise, and finds planted bias.
#include "support/tile_test.h"

#include <gtest/gtest.h>

#include <functional>
#include <limits>
#include <random>

namespace tarn {
namespace {

constexpr int WIDTH = 64;
constexpr int HEIGHT = 64;
constexpr int TRIALS = 200;
constexpr double SIGNIFICANCE = 0.05;
// 200 trials fail 10 times on average; 1 in 1000 runs of a right test leaves this range.
constexpr int MAX_FAILURES = 20;

using Random = std::mt19937_64;
using Noise = std::function<float(Random&)>;  // of mean 1

float gaussian(Random& random) {
    return 1.0f + 0.5f * std::normal_distribution<float>()(random);
}

// One pixel in `rarity` is bright, the others are black or dim.
Noise rare_bright(double rarity, float dim) {
    return [=](Random& random) {
        const bool bright = std::uniform_real_distribution<double>()(random) < 1.0 / rarity;
        return dim + (bright ? (1.0f - dim) * float(rarity) : 0.0f);
    };
}

// Pixels share their value in squares of `blotch_px`: as correlated as resampled images can be.
Image noise_image(Random& random, const Noise& noise, int blotch_px = 1) {
    Image image(WIDTH, HEIGHT, 3);
    for (int y = 0; y < HEIGHT; ++y) {
        for (int x = 0; x < WIDTH; ++x) {
            const int source_x = x / blotch_px * blotch_px;
            const int source_y = y / blotch_px * blotch_px;
            for (int c = 0; c < 3; ++c) {
                const bool own = source_x == x && source_y == y;
                image.pixel(x, y)[c] = own ? noise(random) : image.pixel(source_x, source_y)[c];
            }
        }
    }
    return image;
}

// The true mean 1, known to a standard error per pixel.
TileReference reference_with_error(Random& random, float standard_error) {
    TileReference reference{Image(WIDTH, HEIGHT, 3), Image(WIDTH, HEIGHT, 3)};
    std::normal_distribution<float> normal;
    for (float& mean : reference.mean.values) mean = 1.0f + standard_error * normal(random);
    for (float& variance : reference.variance.values) variance = standard_error * standard_error;
    return reference;
}

int count_failures(const Noise& noise, int seed_count, int blotch_px, int random_seed) {
    Random random(static_cast<unsigned>(random_seed));
    int failures = 0;
    for (int trial = 0; trial < TRIALS; ++trial) {
        TileSamples samples(WIDTH, HEIGHT, 16);
        for (int seed = 0; seed < seed_count; ++seed) samples.add(noise_image(random, noise, blotch_px));
        failures += samples.test(reference_with_error(random, 0.05f), SIGNIFICANCE).passes ? 0 : 1;
    }
    return failures;
}

TEST(TileSamples, fail_by_chance_as_often_as_they_say_on_gaussian_noise) {
    const int failures = count_failures(gaussian, 8, 1, 1);
    EXPECT_GE(failures, 2);  // a test that never fails would have no power either
    EXPECT_LE(failures, MAX_FAILURES);
}

TEST(TileSamples, are_not_fooled_by_correlated_pixels) {
    EXPECT_LE(count_failures(gaussian, 8, 4, 2), MAX_FAILURES);
}

TEST(TileSamples, are_not_fooled_by_rare_bright_samples) {
    EXPECT_LE(count_failures(rare_bright(100, 0.0f), 16, 1, 3), MAX_FAILURES);
    EXPECT_LE(count_failures(rare_bright(1000, 0.0f), 16, 1, 4), MAX_FAILURES);
    EXPECT_LE(count_failures(rare_bright(1000, 0.5f), 32, 1, 5), MAX_FAILURES);
}

TEST(TileSamples, would_be_fooled_by_variances_of_correlated_pixels) {
    Random random(6);
    int failures = 0;
    for (int trial = 0; trial < 20; ++trial) {
        TileReference samples{noise_image(random, gaussian, 4), Image(WIDTH, HEIGHT, 3)};
        for (float& variance : samples.variance.values) variance = 0.25f;
        failures += test_tiles(samples, reference_with_error(random, 0.05f), 16, SIGNIFICANCE).passes ? 0 : 1;
    }
    EXPECT_GE(failures, 18);
}

TEST(TileSamples, find_a_bias_of_two_percent) {
    Random random(7);
    TileSamples biased(WIDTH, HEIGHT, 16);
    TileSamples unbiased(WIDTH, HEIGHT, 16);
    for (int seed = 0; seed < 64; ++seed) {
        unbiased.add(noise_image(random, gaussian));
        Image image = noise_image(random, gaussian);
        for (float& value : image.values) value *= 1.02f;
        biased.add(image);
    }
    const TileReference reference = reference_with_error(random, 0.01f);
    EXPECT_FALSE(biased.test(reference).passes);
    EXPECT_TRUE(unbiased.test(reference).passes);
    EXPECT_FALSE(biased.test(unbiased).passes);
}

TEST(TileSamples, find_a_bias_of_two_percent_among_rare_bright_samples) {
    Random random(8);
    TileSamples biased(WIDTH, HEIGHT, 16);
    for (int seed = 0; seed < 400; ++seed) {
        Image image = noise_image(random, rare_bright(4, 0.0f));
        for (float& value : image.values) value *= 0.98f;
        biased.add(image);
    }
    EXPECT_FALSE(biased.test(reference_with_error(random, 0.01f)).passes);
}

TEST(TileSamples, say_where_the_bias_is) {
    Random random(9);
    TileSamples samples(WIDTH, HEIGHT, 16);
    for (int seed = 0; seed < 32; ++seed) {
        Image image = noise_image(random, gaussian);
        for (int y = 32; y < 48; ++y) {
            for (int x = 16; x < 32; ++x) image.pixel(x, y)[0] *= 1.1f;
        }
        samples.add(image);
    }
    const TileTest test = samples.test(reference_with_error(random, 0.01f));
    EXPECT_FALSE(test.passes);
    EXPECT_EQ(test.tiles, 16);
    EXPECT_EQ(test.x, 16);
    EXPECT_EQ(test.y, 32);
    EXPECT_EQ(test.size_px, 16);
    EXPECT_EQ(test.channel, 0);
    EXPECT_NEAR(test.mean, 1.1, 0.03);
    EXPECT_NEAR(test.reference_mean, 1.0, 0.01);
}

TEST(TileSamples, accept_an_exact_image_and_reject_one_that_is_black_by_mistake) {
    TileReference reference{Image(WIDTH, HEIGHT, 3), Image(WIDTH, HEIGHT, 3)};
    for (float& mean : reference.mean.values) mean = 0.3f;
    TileSamples exact(WIDTH, HEIGHT, 16);
    TileSamples black(WIDTH, HEIGHT, 16);
    for (int seed = 0; seed < 4; ++seed) {
        exact.add(reference.mean);
        black.add(Image(WIDTH, HEIGHT, 3));
    }
    EXPECT_TRUE(exact.test(reference).passes);
    EXPECT_FALSE(black.test(reference).passes);
}

TEST(TileSamples, count_pixels_that_are_not_finite_and_fail_for_them) {
    TileReference reference{Image(WIDTH, HEIGHT, 3), Image(WIDTH, HEIGHT, 3)};
    TileSamples samples(WIDTH, HEIGHT, 16);
    Image image(WIDTH, HEIGHT, 3);
    samples.add(image);
    image.pixel(5, 5)[1] = std::numeric_limits<float>::quiet_NaN();
    image.pixel(6, 5)[2] = std::numeric_limits<float>::infinity();
    samples.add(image);
    const TileTest test = samples.test(reference);
    EXPECT_EQ(test.non_finite, 2u);
    EXPECT_FALSE(test.passes);
}

TEST(TileSamples, cover_images_that_tiles_do_not_divide) {
    TileReference reference{Image(37, 21, 3), Image(37, 21, 3)};
    TileSamples samples(37, 21, 16);
    Image image(37, 21, 3);
    image.pixel(36, 20)[1] = 1.0f;
    samples.add(image);
    samples.add(image);
    const TileTest test = samples.test(reference);
    EXPECT_EQ(test.tiles, 6);
    EXPECT_FALSE(test.passes);
}

// Of 20 runs of 32 seeds, how many ever stand out.
int count_standouts(const Noise& noise, double significance) {
    Random random(11);
    int count = 0;
    for (int trial = 0; trial < 20; ++trial) {
        TileSamples samples(WIDTH, HEIGHT, 16);
        const TileReference reference = reference_with_error(random, 0.05f);
        bool stands_out_once = false;
        for (int seed = 0; seed < 32; ++seed) {
            samples.add(noise_image(random, noise));
            stands_out_once = stands_out_once || stands_out(samples, reference, significance);
        }
        count += stands_out_once ? 1 : 0;
    }
    return count;
}

// Four looks at a hundredth of a half each: one run in 50. Looks at the whole of it find most of the runs.
TEST(StandsOut, right_estimators_do_so_seldom) {
    EXPECT_LE(count_standouts(gaussian, 0.5), 3);
    EXPECT_LE(count_standouts(rare_bright(4.0, 0.2f), 0.5), 3);
}

TEST(StandsOut, a_large_bias_does_so_at_the_first_look) {
    Random random(12);
    TileSamples samples(WIDTH, HEIGHT, 16);
    const TileReference reference = reference_with_error(random, 0.05f);
    for (int seed = 1; seed <= 8; ++seed) {
        samples.add(noise_image(random, [](Random& r) { return 1.5f * gaussian(r); }));
        EXPECT_EQ(stands_out(samples, reference), seed == 8) << seed;
    }
}

TEST(TestTiles, compares_images_of_independent_pixels) {
    Random random(10);
    int failures = 0;
    for (int trial = 0; trial < TRIALS; ++trial) {
        const TileReference a = reference_with_error(random, 0.1f);
        failures += test_tiles(a, reference_with_error(random, 0.05f), 16, SIGNIFICANCE).passes ? 0 : 1;
    }
    EXPECT_LE(failures, MAX_FAILURES);
    TileReference biased = reference_with_error(random, 0.02f);
    for (float& mean : biased.mean.values) mean *= 1.02f;
    EXPECT_FALSE(test_tiles(biased, reference_with_error(random, 0.02f)).passes);
}

}  // namespace
}  // namespace tarn
