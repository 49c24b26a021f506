// The numbers that are read from the blue noise mask: uniform and independent over seeds, dimensions and
// periods, blue over a picture, and better than white noise once a picture is blurred.
#include "noise/blue_noise.h"

#include <gtest/gtest.h>

#include <cstdio>

#include "core/statistics.h"
#include "noise_volume.h"
#include "shared/math/warp.h"
#include "support/histogram.h"

namespace tarn {
namespace {

using glm::ivec3;
using test::Histogram;
using test::NoiseVolume;
using test::SIGNIFICANCE;

constexpr int SIZE = BLUE_NOISE_SIZE, SLICES = BLUE_NOISE_SLICES;
constexpr uint DIMENSION = 77u;

const BlueNoiseMask& mask() {
    static const BlueNoiseMask loaded = load_blue_noise();
    return loaded;
}

vec2 draw(uvec2 pixel, uint frame, uint seed, uint dimension = DIMENSION) {
    return BlueNoiseAccess(mask()).blue_noise2(pixel, frame, seed, dimension);
}

// ---- Where a number comes from

TEST(BlueNoise, NeighboursInSpaceAndTimeReadNeighboursOfTheMask) {
    for (uint seed = 0; seed < 50u; ++seed) {
        const BlueNoiseShift shift = blue_noise_shift(40u, seed, DIMENSION);
        const auto place = [&](uint x, uint y, uint frame) {
            const uint texel = blue_noise_texel(shift, uvec2(x, y), frame);
            return ivec3(int(texel % 64u), int(texel / 64u % 64u), int(texel / 4096u));
        };
        const auto wrapped = [](ivec3 p) { return ivec3(p.x & 63, p.y & 63, p.z & 31); };
        const ivec3 here = place(100u, 200u, 40u);
        EXPECT_EQ(place(101u, 200u, 40u), wrapped(here + ivec3(1, 0, 0)));
        EXPECT_EQ(place(100u, 201u, 40u), wrapped(here + ivec3(0, 1, 0)));
        EXPECT_EQ(place(100u, 200u, 41u), wrapped(here + ivec3(0, 0, 1)));
        EXPECT_EQ(place(164u, 136u, 40u), here);
    }
}

TEST(BlueNoise, StaysBelowOneAtTheExtremes) {
    const BlueNoiseShift most = {0x1ffffu, 0xfffffu, 0xffffffffu};
    EXPECT_EQ(shift_blue_noise(most, 0x0000fff0u), vec2(1.0f - 0x1p-24f));
    EXPECT_EQ(shift_blue_noise({0u, 0u, 0u}, 0u), vec2(0.0f));
    EXPECT_EQ(shift_blue_noise({0u, 0u, 0x80000000u}, 0xfff00000u).y, 0.5f - 0x1p-12f);
}

// ---- Uniform over seeds

// All shifts that a hash can give, for one texel. Exact: the first number takes each rank equally often over
// all places, the second each of 4096 steps once over as many turns, whatever the place.
TEST(BlueNoise, OverAllShiftsBothNumbersAreExactlyUniform) {
    std::vector<int> firsts(4096), seconds(4096);
    for (uint place = 0; place < BLUE_NOISE_TEXEL_COUNT; ++place) {
        const BlueNoiseShift shift = {place, 0xabcdeu, place << 20u};
        const uint texel = mask().texels[blue_noise_texel(shift, uvec2(5u, 50u), 9u)];
        ++firsts[int(shift_blue_noise(shift, texel).x * 4096.0f)];
    }
    EXPECT_EQ(firsts, std::vector<int>(4096, SLICES));
    for (uint turn = 0; turn < 4096u; ++turn)
        ++seconds[int(shift_blue_noise({0u, 0u, turn << 20u}, mask().texels[12345]).y * 4096.0f)];
    EXPECT_EQ(seconds, std::vector<int>(4096, 1));
}

using Draw = std::function<vec2(uint seed)>;

// p value of "both numbers together fill the square over seeds".
double seeds_p_value(const Draw& draw_seed) {
    Histogram histogram(16, 16);
    for (uint seed = 0; seed < 1u << 16; ++seed) {
        const vec2 u = draw_seed(seed);
        histogram.add(u.x, u.y);
    }
    return histogram.uniform_p_value();
}

TEST(BlueNoise, OverSeedsBothNumbersFillTheSquare) {
    for (const uvec2 pixel : {uvec2(0u), uvec2(63u, 64u), uvec2(1919u, 1079u)}) {
        for (const uint frame : {0u, 31u, 1000u}) {
            const double p = seeds_p_value([&](uint seed) { return draw(pixel, frame, seed); });
            EXPECT_GT(p, sidak_threshold(SIGNIFICANCE, 9));
        }
    }
}

TEST(BlueNoise, NegativeControlAMaskThatStaysInPlaceIsFound) {
    const uint texel = mask().texels[777];
    const Draw only_turned = [&](uint seed) {
        return shift_blue_noise(blue_noise_shift(0u, seed, DIMENSION), texel);
    };
    EXPECT_LT(seeds_p_value(only_turned), SIGNIFICANCE);
}

// ---- Independent

TEST(BlueNoise, SeedsDimensionsAndPeriodsAreIndependent) {
    const uvec2 pixel(17u, 4u);
    const std::pair<const char*, Draw> pairs[] = {
        {"first numbers of two seeds",
         [&](uint s) { return vec2(draw(pixel, 0u, s).x, draw(pixel, 0u, s + 65536u).x); }},
        {"second numbers of two seeds",
         [&](uint s) { return vec2(draw(pixel, 0u, s).y, draw(pixel, 0u, s + 65536u).y); }},
        {"first numbers of two dimensions",
         [&](uint s) { return vec2(draw(pixel, 0u, s, 1u).x, draw(pixel, 0u, s, 2u).x); }},
        {"second numbers of two dimensions",
         [&](uint s) { return vec2(draw(pixel, 0u, s, 1u).y, draw(pixel, 0u, s, 2u).y); }},
        {"first numbers of two periods",
         [&](uint s) { return vec2(draw(pixel, 5u, s).x, draw(pixel, 37u, s).x); }},
        {"second numbers of two periods",
         [&](uint s) { return vec2(draw(pixel, 5u, s).y, draw(pixel, 37u, s).y); }},
    };
    for (const auto& [name, draw_pair] : pairs)
        EXPECT_GT(seeds_p_value(draw_pair), sidak_threshold(SIGNIFICANCE, 6)) << name;
    const Draw same_period = [&](uint s) { return vec2(draw(pixel, 5u, s).x, draw(pixel, 6u, s).x); };
    EXPECT_LT(seeds_p_value(same_period), SIGNIFICANCE) << "two frames of a period are blue to each other";
}

// p value of "in one picture over one period the pairs (a, b) of its pixels fill the square".
template <class Pair>
double picture_p_value(const Pair& pair) {
    Histogram histogram(16, 16);
    for (uint frame = 0; frame < uint(SLICES); ++frame) {
        for (uint i = 0; i < uint(SIZE * SIZE); ++i) {
            const vec2 u = pair(uvec2(i % 64u, i / 64u), frame);
            histogram.add(u.x, u.y);
        }
    }
    return histogram.uniform_p_value();
}

// A shift of the values alone would give all pixels the same relation between two dimensions: their mean over
// the picture would be wrong, in a way that no blur removes.
TEST(BlueNoise, InOnePictureTwoDimensionsFillTheSquare) {
    for (uint seed = 0; seed < 8u; ++seed) {
        const double p = picture_p_value([&](uvec2 pixel, uint frame) {
            return vec2(draw(pixel, frame, seed, 1u).x, draw(pixel, frame, seed, 2u).x);
        });
        EXPECT_GT(p, sidak_threshold(SIGNIFICANCE, 8)) << seed;
    }
    const double turned_alone = picture_p_value([&](uvec2 pixel, uint frame) {
        const uint texel = mask().texels[blue_noise_texel({0u, 0u, 0u}, pixel, frame)];
        return vec2(shift_blue_noise({0u, 0u, 1u << 30}, texel).y,
                    shift_blue_noise({0u, 0u, 3u << 29}, texel).y);
    });
    EXPECT_LT(turned_alone, SIGNIFICANCE);
}

// ---- Blue

NoiseVolume volume_of(int number, uint seed) {
    return {SIZE, SIZE, SLICES,
            [&](int x, int y, int t) { return draw(uvec2(uint(x), uint(y)), uint(t), seed)[number]; }};
}

TEST(BlueNoise, TheFirstNumberKeepsTheMasksSpectrumAndTheSecondMostOfIt) {
    for (uint seed = 0; seed < 3u; ++seed) {
        const NoiseVolume first = volume_of(0, seed), second = volume_of(1, seed);
        std::printf("power at 1 to 8 of 64 cycles: %.4f, %.3f; over time, 1 to 3: %.4f, %.3f\n",
                    slice_power(first, 1, 8), slice_power(second, 1, 8), time_power(first, 1, 3),
                    time_power(second, 1, 3));
        EXPECT_LT(slice_power(first, 1, 8), 1.0 / 50.0);
        EXPECT_LT(time_power(first, 1, 3), 1.0 / 8.0);
        EXPECT_LT(slice_power(second, 1, 8), 1.0 / 5.0);
        EXPECT_LT(time_power(second, 1, 3), 1.0 / 1.5);
    }
}

// ---- Better than white noise

// Radiance that a cosine-weighted ray sees under a smooth sky with a brighter side, whose place changes over
// the picture.
double shade(vec2 u, int x, int y) {
    const vec3 direction = sample_cosine_hemisphere(u);
    const double turn = 0.02 * x, rise = 0.01 * y;
    const double towards = direction.x * std::cos(turn) + direction.y * std::sin(turn);
    return std::exp(1.5 * towards + rise * direction.z);
}

double expected_shade(int x, int y) {
    constexpr int STEPS = 48;
    double sum = 0;
    for (int i = 0; i < STEPS * STEPS; ++i)
        sum += shade(vec2((float(i % STEPS) + 0.5f) / STEPS, (float(i / STEPS) + 0.5f) / STEPS), x, y);
    return sum / (STEPS * STEPS);
}

double root_mean_square(const NoiseVolume& errors, int radius) {
    double squares = 0;
    for (int t = 0; t < errors.slices(); ++t) {
        for (int y = radius; y < errors.height() - radius; ++y) {
            for (int x = radius; x < errors.width() - radius; ++x)
                squares += std::pow(blur(errors, x, y, t, radius), 2);
        }
    }
    const int inner = (errors.width() - 2 * radius) * (errors.height() - 2 * radius);
    return std::sqrt(squares / (inner * errors.slices()));
}

TEST(BlueNoise, OneSampleAPixelHasHalfTheErrorOfWhiteNoiseAfterABlur) {
    constexpr int FRAMES = 8;
    std::vector<double> expected;
    for (int i = 0; i < SIZE * SIZE; ++i) expected.push_back(expected_shade(i % SIZE, i / SIZE));
    const auto errors = [&](const auto& number) {
        return NoiseVolume(SIZE, SIZE, FRAMES, [&](int x, int y, int t) {
            return shade(number(x, y, t), x, y) - expected[x + SIZE * y];
        });
    };
    const NoiseVolume blue = errors([](int x, int y, int t) { return draw(uvec2(x, y), uint(t), 1u); });
    const NoiseVolume white = errors([](int x, int y, int t) {
        return vec2(random4({uint(x + SIZE * y), uint(t), 1u}, DIMENSION));
    });
    std::printf("error of a pixel: %.4f blue, %.4f white; of a 5 x 5 mean: %.4f blue, %.4f white\n",
                root_mean_square(blue, 0), root_mean_square(white, 0), root_mean_square(blue, 2),
                root_mean_square(white, 2));
    EXPECT_NEAR(root_mean_square(blue, 0) / root_mean_square(white, 0), 1.0, 0.05);
    EXPECT_LT(root_mean_square(blue, 2), 0.6 * root_mean_square(white, 2));
}

// Error of a pixel's mean over `frames` frames, over seeds.
double error_of_means(int frames) {
    const double expected = expected_shade(0, 0);
    double squares = 0;
    for (uint seed = 0; seed < 400u; ++seed) {
        double sum = 0;
        for (int t = 0; t < frames; ++t) sum += shade(draw(uvec2(3u, 4u), uint(t), seed), 0, 0);
        squares += std::pow(sum / frames - expected, 2);
    }
    return std::sqrt(squares / 400.0);
}

TEST(BlueNoise, MeansOverManyPeriodsConverge) {
    EXPECT_LT(error_of_means(16 * SLICES), 0.35 * error_of_means(SLICES));
}

}  // namespace
}  // namespace tarn
