// The share of pixels that hold a neighbour's sample, on pictures whose share is known.
#include "metrics/shared_samples.h"

#include <gtest/gtest.h>

namespace tarn {
namespace {

// One channel of identities as a picture of three; 0: black.
Image samples_of(int width, int height, const std::vector<int>& ids) {
    Image image(width, height, 3);
    for (std::size_t i = 0; i < ids.size(); ++i) {
        for (std::size_t c = 0; c < 3; ++c) image.values[3 * i + c] = float(ids[i]) / float(c + 1);
    }
    return image;
}

TEST(SharedSamples, NeighboursOnAllEightSidesCount) {
    const Image all_different = samples_of(3, 3, {1, 2, 3, 4, 5, 6, 7, 8, 9});
    EXPECT_EQ(find_shared_sample_share(all_different), 0.0);
    const Image diagonal = samples_of(3, 3, {1, 2, 3, 4, 1, 6, 7, 8, 9});
    EXPECT_DOUBLE_EQ(find_shared_sample_share(diagonal), 2.0 / 9.0);
    const Image too_far = samples_of(3, 3, {1, 2, 1, 4, 5, 6, 7, 8, 2});
    EXPECT_EQ(find_shared_sample_share(too_far), 0.0);
    EXPECT_EQ(find_shared_sample_share(samples_of(2, 2, {5, 5, 5, 5})), 1.0);
}

TEST(SharedSamples, PixelsWithoutASampleAreNoPartOfIt) {
    EXPECT_DOUBLE_EQ(find_shared_sample_share(samples_of(4, 1, {0, 0, 3, 3})), 1.0);
    EXPECT_DOUBLE_EQ(find_shared_sample_share(samples_of(4, 1, {0, 2, 3, 3})), 2.0 / 3.0);
    EXPECT_EQ(find_shared_sample_share(samples_of(2, 1, {0, 0})), 0.0);
}

// A colour that agrees in two channels is another sample.
TEST(SharedSamples, AllChannelsMustAgree) {
    Image image = samples_of(2, 1, {4, 4});
    image.values[5] += 1.0f / 256.0f;
    EXPECT_EQ(find_shared_sample_share(image), 0.0);
}

}  // namespace
}  // namespace tarn
