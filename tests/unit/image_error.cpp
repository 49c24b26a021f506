// Error sums and SSIM against cases computed by hand.
#include "metrics/image_error.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/error.h"
#include "metrics/ssim.h"

namespace tarn {
namespace {

Image image_of(int width, int height, std::vector<float> values) {
    Image image(width, height, 3);
    image.values = std::move(values);
    return image;
}

TEST(ImageErrors, match_a_case_computed_by_hand) {
    const Image reference = image_of(2, 1, {1, 1, 1, 0, 0, 0});
    const Image image = image_of(2, 1, {1.1f, 1, 0.9f, 0.1f, 0, 0});
    const ImageErrors errors = compute_image_errors(reference, image);
    EXPECT_NEAR(errors.mse, 0.03 / 6, 1e-8);
    EXPECT_NEAR(errors.rmse, std::sqrt(0.005), 1e-7);
    EXPECT_NEAR(errors.rel_mse, (0.02 / 1.01 + 0.01 / 0.01) / 6, 1e-7);
    EXPECT_NEAR(errors.rel_mse_trimmed, errors.rel_mse, 1e-15);  // 0.1 % of two pixels is none
    EXPECT_NEAR(errors.rmspe, 100 * std::sqrt((0.02 / (1.01 * 1.01) + 0.01 / (0.01 * 0.01)) / 6), 1e-4);
    EXPECT_NEAR(errors.mape, 100 * (0.2 / 1.01 + 0.1 / 0.01) / 6, 1e-4);
    EXPECT_NEAR(errors.mean_ratio, 3.1 / 3.0, 1e-7);
    EXPECT_EQ(errors.pixels, 2u);
    EXPECT_EQ(errors.non_finite, 0u);
}

TEST(ImageErrors, of_equal_images_are_zero) {
    const Image image = image_of(1, 2, {1, 2, 3, 4, 5, 6});
    const ImageErrors errors = compute_image_errors(image, image);
    EXPECT_EQ(errors.mse, 0.0);
    EXPECT_EQ(errors.rel_mse, 0.0);
    EXPECT_EQ(errors.rmspe, 0.0);
    EXPECT_EQ(errors.mape, 0.0);
    EXPECT_EQ(errors.mean_ratio, 1.0);
}

TEST(ImageErrors, are_asymmetric_where_they_divide_by_the_reference) {
    const Image a = image_of(1, 1, {2, 2, 2});
    const Image b = image_of(1, 1, {1, 1, 1});
    EXPECT_NEAR(compute_image_errors(a, b).rel_mse, 1 / 4.01, 1e-12);
    EXPECT_NEAR(compute_image_errors(b, a).rel_mse, 1 / 1.01, 1e-12);
    EXPECT_NEAR(compute_image_errors(a, b).mean_ratio, 0.5, 1e-12);
    EXPECT_NEAR(compute_image_errors(a, b).mape, 100 / 2.01, 1e-9);
}

TEST(ImageErrors, trim_one_pixel_in_a_thousand) {
    Image reference(50, 40, 3);
    for (float& value : reference.values) value = 1.0f;
    Image image = reference;
    for (float& value : image.values) value = 1.5f;
    const double plain = compute_image_errors(reference, image).rel_mse;
    for (int c = 0; c < 3; ++c) image.pixel(7, 7)[c] = image.pixel(9, 30)[c] = 1000.0f;
    const ImageErrors errors = compute_image_errors(reference, image);
    EXPECT_NEAR(plain, 0.25 / 1.01, 1e-9);
    EXPECT_NEAR(errors.rel_mse_trimmed, plain, 1e-12);
    EXPECT_GT(errors.rel_mse, 900.0);
}

TEST(ImageErrors, scale_with_exposure) {
    const Image reference = image_of(1, 1, {1, 1, 1});
    const Image image = image_of(1, 1, {2, 2, 2});
    const ImageErrors errors = compute_image_errors(reference, image, 0.1);
    EXPECT_NEAR(errors.mse, 0.01, 1e-12);
    EXPECT_NEAR(errors.rel_mse, 0.01 / 0.02, 1e-12);
    EXPECT_NEAR(errors.mape, 100 * 0.1 / 0.11, 1e-9);
}

TEST(ImageErrors, leave_out_and_count_pixels_that_are_not_finite) {
    Image reference = image_of(3, 1, {1, 1, 1, 1, 1, 1, 1, 1, 1});
    Image image = image_of(3, 1, {2, 2, 2, 2, 2, 2, 2, 2, 2});
    image.values[1] = std::numeric_limits<float>::quiet_NaN();
    reference.values[8] = std::numeric_limits<float>::infinity();
    const ImageErrors errors = compute_image_errors(reference, image);
    EXPECT_EQ(errors.non_finite, 2u);
    EXPECT_EQ(errors.pixels, 1u);
    EXPECT_DOUBLE_EQ(errors.mse, 1.0);
    EXPECT_DOUBLE_EQ(errors.mean_ratio, 2.0);
    image.values[3] = std::numeric_limits<float>::quiet_NaN();
    EXPECT_THROW(compute_image_errors(reference, image), Error);
}

TEST(ImageErrors, know_the_ratio_of_black_images) {
    const Image black(2, 2, 3);
    const Image white = image_of(1, 1, {1, 1, 1});
    EXPECT_EQ(compute_image_errors(black, black).mean_ratio, 1.0);
    EXPECT_EQ(compute_image_errors(Image(1, 1, 3), white).mean_ratio,
              std::numeric_limits<double>::infinity());
}

TEST(ImageErrors, refuse_images_of_different_size) {
    EXPECT_THROW(compute_image_errors(Image(2, 2, 3), Image(2, 3, 3)), Error);
    EXPECT_THROW(compute_image_errors(Image(2, 2, 3), Image(2, 2, 1)), Error);
}

TEST(Ssim, of_constant_images_compares_means_alone) {
    const Image a = image_of(1, 1, {0.5f, 0.5f, 0.5f});
    const Image b = image_of(1, 1, {0.6f, 0.6f, 0.6f});
    EXPECT_NEAR(compute_ssim(a, b), 0.6001 / 0.6101, 1e-5);
    EXPECT_NEAR(compute_ssim(a, a), 1.0, 1e-12);
}

// The expected value is that of a direct two-dimensional sum in double precision.
TEST(Ssim, matches_a_direct_evaluation_of_its_definition) {
    Image a(16, 9, 3);
    Image b(16, 9, 3);
    for (int y = 0; y < 9; ++y) {
        for (int x = 0; x < 16; ++x) {
            a.pixel(x, y)[0] = float((3 * x + 5 * y) % 7) / 6.0f;
            b.pixel(x, y)[0] = float((3 * x + 5 * y + 1) % 7) / 6.0f;
            a.pixel(x, y)[1] = b.pixel(x, y)[1] = float((2 * x + y) % 5) / 4.0f;
            a.pixel(x, y)[2] = float((x + 4 * y) % 9) / 8.0f;
            b.pixel(x, y)[2] = float((x + 4 * y + x / 5) % 9) / 8.0f;
        }
    }
    EXPECT_NEAR(compute_ssim(a, b), 0.942341264, 1e-5);
}

}  // namespace
}  // namespace tarn
