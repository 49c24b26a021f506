// Enlarged pictures against values computed by hand.
#include "bench/resize.h"

#include <gtest/gtest.h>

namespace tarn {
namespace {

TEST(Resize, DoublingLandsAQuarterOfTheWayBetweenCentres) {
    Image image(2, 1, 1);
    image.values = {0.0f, 4.0f};
    EXPECT_EQ(resize_bilinear(image, 4, 1).values, (std::vector<float>{0.0f, 1.0f, 3.0f, 4.0f}));
    EXPECT_EQ(resize_bilinear(image, 4, 2).values,
              (std::vector<float>{0.0f, 1.0f, 3.0f, 4.0f, 0.0f, 1.0f, 3.0f, 4.0f}));
}

TEST(Resize, TheSameSizeIsTheSamePicture) {
    Image image(3, 2, 3);
    for (std::size_t i = 0; i < image.values.size(); ++i) image.values[i] = float(i * i % 7);
    EXPECT_EQ(resize_bilinear(image, 3, 2).values, image.values);
}

// What is linear in the place stays so, away from the edges.
TEST(Resize, ARampStaysARampInBothDirections) {
    Image image(8, 6, 1);
    for (int y = 0; y < 6; ++y) {
        for (int x = 0; x < 8; ++x) *image.pixel(x, y) = float(2.0 * (x + 0.5) / 8.0 + 5.0 * (y + 0.5) / 6.0);
    }
    const Image large = resize_bilinear(image, 20, 30);
    for (int y = 3; y < 27; ++y) {
        for (int x = 2; x < 18; ++x) {
            EXPECT_NEAR(*large.pixel(x, y), 2.0 * (x + 0.5) / 20.0 + 5.0 * (y + 0.5) / 30.0, 1e-5);
        }
    }
}

}  // namespace
}  // namespace tarn
