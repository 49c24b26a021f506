// The split of error into bias and variance: by hand, in coverage, and its view of correlated neighbours.
#include "metrics/bias_variance.h"

#include <gtest/gtest.h>

#include <limits>
#include <random>
#include <vector>

#include "core/error.h"

namespace tarn {
namespace {

std::vector<Image> noisy_images(std::mt19937& random, int count, int width, int height, float bias,
                                int blotch_px) {
    std::normal_distribution<float> normal;
    std::vector<Image> images;
    for (int k = 0; k < count; ++k) {
        Image image(width, height, 3);
        for (int y = 0; y < height; ++y) {
            for (int x = 0; x < width; ++x) {
                for (int c = 0; c < 3; ++c) {
                    const bool repeats = x % blotch_px != 0;
                    image.pixel(x, y)[c] = repeats ? image.pixel(x - 1, y)[c] : bias + normal(random);
                }
            }
        }
        images.push_back(image);
    }
    return images;
}

TEST(BiasVariance, matches_a_case_computed_by_hand) {
    const Image reference(1, 1, 3);
    std::vector<Image> images(3, Image(1, 1, 3));
    for (int k = 0; k < 3; ++k)
        images[std::size_t(k)].values = {1.0f + float(k), 1.0f + float(k), 1.0f + float(k)};
    const BiasVariance split = split_bias_variance(reference, images);
    EXPECT_DOUBLE_EQ(split.mse_of_mean, 4.0);
    EXPECT_DOUBLE_EQ(split.variance, 1.0);
    EXPECT_NEAR(split.bias_squared, 4.0 - 1.0 / 3.0, 1e-12);
    EXPECT_NEAR(split_bias_variance(reference, images, 0.5).bias_squared, 3.5 - 1.0 / 3.0, 1e-12);
}

TEST(BiasVariance, interval_holds_the_truth_nineteen_times_in_twenty) {
    std::mt19937 random(3);
    const Image reference(16, 16, 3);
    for (const float bias : {0.3f, 1.0f}) {
        int covered = 0;
        for (int trial = 0; trial < 300; ++trial) {
            const BiasVariance split =
                split_bias_variance(reference, noisy_images(random, 8, 16, 16, bias, 1));
            const double truth = double(bias) * bias;
            covered += split.bias_squared_low <= truth && truth <= split.bias_squared_high ? 1 : 0;
        }
        // Expected 285, deviation 4.
        EXPECT_GE(covered, 270) << bias;
        EXPECT_LE(covered, 298) << bias;
    }
}

TEST(BiasVariance, finds_no_bias_in_unbiased_noise) {
    std::mt19937 random(4);
    const BiasVariance split =
        split_bias_variance(Image(32, 32, 3), noisy_images(random, 16, 32, 32, 0.0f, 1));
    EXPECT_LT(split.bias_squared_low, 0.0);
    EXPECT_GT(split.bias_squared_high, 0.0);
    EXPECT_NEAR(split.variance, 1.0, 0.03);
    EXPECT_NEAR(split.mse_of_mean, 1.0 / 16, 0.01);
}

TEST(BiasVariance, sees_blotches) {
    std::mt19937 random(5);
    const Image reference(32, 32, 3);
    const BiasVariance sharp = split_bias_variance(reference, noisy_images(random, 8, 32, 32, 0.2f, 1));
    // Of the horizontal neighbours 16 in 31 share their value, of the vertical ones none.
    const BiasVariance blotchy = split_bias_variance(reference, noisy_images(random, 8, 32, 32, 0.2f, 2));
    EXPECT_NEAR(sharp.neighbour_autocorrelation, 0.0, 0.02);
    EXPECT_NEAR(blotchy.neighbour_autocorrelation, 0.5 * 16 / 31, 0.02);
    EXPECT_NEAR(blotchy.neighbour_autocovariance, 0.5 * 16 / 31, 0.03);
    EXPECT_NEAR(sharp.variance, blotchy.variance, 0.05);
}

TEST(BiasVariance, leaves_out_and_counts_pixels_that_are_not_finite) {
    std::vector<Image> images(3, Image(2, 1, 3));
    images[1].values[0] = std::numeric_limits<float>::infinity();
    for (Image& image : images) image.values[3] = 3.0f;
    const BiasVariance split = split_bias_variance(Image(2, 1, 3), images);
    EXPECT_EQ(split.non_finite, 1u);
    EXPECT_NEAR(split.bias_squared, 3.0, 1e-12);
}

TEST(BiasVariance, refuses_too_few_images_and_different_sizes) {
    const std::vector<Image> two(2, Image(1, 1, 3));
    EXPECT_THROW(split_bias_variance(Image(1, 1, 3), two), Error);
    const std::vector<Image> three(3, Image(1, 1, 3));
    EXPECT_THROW(split_bias_variance(Image(1, 2, 3), three), Error);
}

}  // namespace
}  // namespace tarn
