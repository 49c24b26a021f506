// The mask that the build has made: blue in space and time without seams, even ranks, an even square, the
// same bytes.
#include <gtest/gtest.h>

#include <algorithm>

#include "blue_noise/mask_file.h"
#include "noise/blue_noise.h"
#include "noise/mask_format.h"
#include "noise_volume.h"
#include "support/draws.h"
#include "support/process.h"

namespace tarn {
namespace {

using test::NoiseVolume;

constexpr int SIZE = BLUE_NOISE_SIZE, SLICES = BLUE_NOISE_SLICES, AREA = SIZE * SIZE;

const BlueNoiseMask& mask() {
    static const BlueNoiseMask loaded = load_blue_noise();
    return loaded;
}

int value(int channel, int texel) {
    return int(mask().texels[texel] >> (16 * channel) & 0xffffu);
}

NoiseVolume volume_of(int channel) {
    return {SIZE, SIZE, SLICES, [&](int x, int y, int t) { return value(channel, x + SIZE * y + AREA * t); }};
}

// ---- Blue: power against that of white noise, below 8 cycles in 64 pixels and below 4 in 32 frames.

bool is_blue_in_space(const NoiseVolume& volume) {
    return slice_power(volume, 1, 8) < 1.0 / 50.0 && slice_power(volume, 20, 46) > 1.0;
}

bool is_blue_over_time(const NoiseVolume& volume) {
    return time_power(volume, 1, 3) < 1.0 / 8.0 && time_power(volume, 8, 16) > 1.0;
}

class EachChannel : public testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(BlueNoiseMask, EachChannel, testing::Values(0, 1));

TEST_P(EachChannel, IsBlueInEachSliceAndOverTime) {
    const NoiseVolume volume = volume_of(GetParam());
    std::printf(
        "power in slices, 1 to 8 cycles: %.4f, 20 to 46: %.3f; over time, 1 to 3: %.4f, 8 to 16: %.3f\n",
        slice_power(volume, 1, 8), slice_power(volume, 20, 46), time_power(volume, 1, 3),
        time_power(volume, 8, 16));
    EXPECT_TRUE(is_blue_in_space(volume));
    EXPECT_TRUE(is_blue_over_time(volume));
}

TEST(BlueNoiseMask, NegativeControlWhiteNoiseIsNeither) {
    test::Draws draws(1);
    const NoiseVolume white(SIZE, SIZE, SLICES, [&](int, int, int) { return draws.uniform(); });
    EXPECT_NEAR(slice_power(white, 1, 8), 1.0, 0.1);
    EXPECT_NEAR(time_power(white, 1, 3), 1.0, 0.1);
    EXPECT_FALSE(is_blue_in_space(white));
    EXPECT_FALSE(is_blue_over_time(white));
}

TEST(BlueNoiseMask, NegativeControlSlicesOfAnyPlaceAreNotBlueOverTime) {
    const NoiseVolume mask = volume_of(0);
    const NoiseVolume rolled(SIZE, SIZE, SLICES, [&](int x, int y, int t) {
        const uvec4 place = hash_pcg4d(uvec4(uint(t)));
        return mask.at(x + int(place.x % 64u), y + int(place.y % 64u), t);
    });
    EXPECT_TRUE(is_blue_in_space(rolled));
    EXPECT_FALSE(is_blue_over_time(rolled));
}

TEST(BlueNoiseMask, NegativeControlPixelsOfAnyPlaceAreNotBlueInSpace) {
    const NoiseVolume mask = volume_of(0);
    const NoiseVolume scattered(SIZE, SIZE, SLICES, [&](int x, int y, int t) {
        const uint place = hash_pcg4d(uvec4(uint(x), uint(y), 0u, 0u)).x % uint(AREA);
        return mask.at(int(place) % SIZE, int(place) / SIZE, t);
    });
    EXPECT_FALSE(is_blue_in_space(scattered));
    EXPECT_TRUE(is_blue_over_time(scattered));
}

TEST(BlueNoiseMask, NegativeControlTimeAndColumnsExchangedAreNotBlueInSpace) {
    const NoiseVolume mask = volume_of(0);
    const NoiseVolume turned(SLICES, SIZE, SIZE, [&](int x, int y, int t) { return mask.at(t, y, x); });
    EXPECT_FALSE(is_blue_in_space(turned));
}

// ---- Without seams

constexpr double LARGEST_SEAM = 1.15;

TEST_P(EachChannel, HasNoSeamWhereItRepeats) {
    EXPECT_LT(seam_ratio(volume_of(GetParam())), LARGEST_SEAM);
}

TEST(BlueNoiseMask, NegativeControlAPartOfALargerMaskHasASeam) {
    const noise::Ranks ranks = noise::make_blue_noise({128, 64, 4}, 1);
    const NoiseVolume part(64, 64, 4, [&](int x, int y, int t) { return ranks[x + 128 * (y + 64 * t)]; });
    EXPECT_GT(seam_ratio(part), LARGEST_SEAM);
}

// ---- Even

TEST_P(EachChannel, HasEachRankOnceInEachSlice) {
    for (int slice = 0; slice < SLICES; ++slice) {
        std::vector<int> counts(AREA);
        for (int texel = 0; texel < AREA; ++texel) {
            const int here = value(GetParam(), slice * AREA + texel);
            ASSERT_EQ(here % 16, 0) << "bits below the rank are for the shift";
            ++counts[here / 16];
        }
        EXPECT_EQ(counts, std::vector<int>(AREA, 1)) << slice;
    }
}

// The most and the fewest points (first, second) of a slice in one of 16 x 16 boxes.
template <class First, class Second>
std::pair<int, int> count_in_boxes(const First& first, const Second& second) {
    std::vector<int> counts(SLICES * 256);
    for (int texel = 0; texel < AREA * SLICES; ++texel)
        ++counts[texel / AREA * 256 + first(texel) / 4096 * 16 + second(texel) / 4096];
    const auto [least, most] = std::minmax_element(counts.begin(), counts.end());
    return {*least, *most};
}

TEST(BlueNoiseMask, FillsTheSquareEvenlyInEachSlice) {
    const auto first = [](int texel) { return value(0, texel); };
    const auto second = [](int texel) { return value(1, texel); };
    EXPECT_EQ(count_in_boxes(first, second), std::pair(16, 16));
    EXPECT_EQ(count_in_boxes(first, first), std::pair(0, 256)) << "the same number twice";
    const auto independent = [](int texel) { return value(0, (texel + 5 * AREA / 2) % (AREA * SLICES)); };
    const auto [least, most] = count_in_boxes(first, independent);
    EXPECT_TRUE(least < 10 && most > 24) << "a number of another place";
}

// ---- The same bytes

TEST(BlueNoiseMask, TheBuildsFileIsWhatTheGeneratorMakesAgain) {
    const std::string built =
        test::read_text(std::filesystem::path(TARN_BUILD_DIR) / "noise" / BLUE_NOISE_FILE);
    const std::vector<unsigned char> again = noise::make_mask_file({}, 1);
    EXPECT_EQ(std::vector<unsigned char>(built.begin(), built.end()), again);
}

}  // namespace
}  // namespace tarn
