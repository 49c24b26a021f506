// Counter-based random numbers: known answers, range, uniformity, independence of neighbouring keys.
#include "shared/math/random.h"

#include <gtest/gtest.h>

#include <bit>
#include <functional>

#include "core/statistics.h"
#include "support/histogram.h"

namespace tarn {
namespace {

using test::Histogram;
using test::SIGNIFICANCE;

constexpr int DRAW_COUNT = 1 << 17;

// Which word of the key a test counts through, the others standing still.
enum class Counter { PIXEL, FRAME, SEED, DIMENSION };

uvec4 key_words(Counter counter, uint index) {
    uvec4 words(1234567u, 17u, 3u, DIMENSION_CANDIDATE);
    words[int(counter)] += index;
    return words;
}

using Hash = std::function<uvec4(uvec4)>;

// p value of "words a of key n and b of the next key are uniform and independent", in 16 x 16 bins.
double neighbours_p_value(const Hash& hash, Counter counter, int a, int b) {
    Histogram histogram(16, 16);
    for (uint i = 0; i < uint(DRAW_COUNT); ++i) {
        const uvec4 here = hash(key_words(counter, 2u * i));
        const uvec4 next = hash(key_words(counter, 2u * i + 1u));
        histogram.add(float_from_bits(here[a]), float_from_bits(next[b]));
    }
    return histogram.uniform_p_value();
}

double worst_neighbours_p_value(const Hash& hash) {
    double worst = 1.0;
    for (const Counter counter : {Counter::PIXEL, Counter::FRAME, Counter::SEED, Counter::DIMENSION}) {
        for (int a = 0; a < 4; ++a) {
            for (int b = 0; b < 4; ++b) worst = std::min(worst, neighbours_p_value(hash, counter, a, b));
        }
    }
    return worst;
}

TEST(Random, Pcg4dGivesTheAnswersOfAnIndependentImplementation) {
    // Computed with unbounded integers in Python from the formula in the paper.
    struct Case {
        uvec4 key;
        uvec4 answer;
    };
    const Case cases[] = {
        {{0x0u, 0x0u, 0x0u, 0x0u}, {0x0f02f829u, 0x2d568769u, 0x32b0c43bu, 0xd32548eau}},
        {{0x1u, 0x0u, 0x0u, 0x0u}, {0x0b3cefc3u, 0xa31dc1d5u, 0x5ffbe5a5u, 0x623d099eu}},
        {{0x0u, 0x1u, 0x0u, 0x0u}, {0x2a9d71a8u, 0xa13cdd97u, 0xe9c89c0eu, 0xc4b7884cu}},
        {{0x0u, 0x0u, 0x1u, 0x0u}, {0x2eda6c9du, 0x681d2eedu, 0x306c117du, 0xb0607dceu}},
        {{0x0u, 0x0u, 0x0u, 0x1u}, {0x8d9effe2u, 0xa833f3dcu, 0x8246b1b2u, 0x58ab6650u}},
        {{0xffffffffu, 0xffffffffu, 0xffffffffu, 0xffffffffu},
         {0x974ed892u, 0xc015dc67u, 0x9f955760u, 0xa1bba208u}},
        {{0x75bcd15u, 0x2au, 0x7u, 0x1000u}, {0xac637e9du, 0xabf3bdebu, 0x1f8c2fd4u, 0x9b36d58bu}},
        {{0x1fa3ffu, 0x3ffu, 0xdeadbeefu, 0x10u}, {0x7e1726f4u, 0x837ada74u, 0xd7ede44eu, 0x19f43599u}},
    };
    for (const Case& c : cases) {
        EXPECT_EQ(hash_pcg4d(c.key), c.answer);
        const RandomKey key{c.key.x, c.key.y, c.key.z};
        EXPECT_EQ(random_bits4(key, c.key.w), c.answer);
    }
}

TEST(Random, FloatsFromTheExtremeBitsStayInZeroToBelowOne) {
    EXPECT_EQ(float_from_bits(0u), 0.0f);
    EXPECT_EQ(float_from_bits(0xffu), 0.0f);
    EXPECT_EQ(float_from_bits(0x100u), 0x1p-24f);
    EXPECT_EQ(float_from_bits(0xffffffffu), 1.0f - 0x1p-24f);
}

TEST(Random, TheFourNumbersOfAKeyAreUniformAndPairwiseIndependent) {
    for (int a = 0; a < 4; ++a) {
        for (int b = a + 1; b < 4; ++b) {
            Histogram histogram(16, 16);
            for (uint pixel = 0; pixel < uint(DRAW_COUNT); ++pixel) {
                const vec4 u = random4({pixel, 0u, 0u}, DIMENSION_SELECT);
                histogram.add(u[a], u[b]);
            }
            EXPECT_GT(histogram.uniform_p_value(), SIGNIFICANCE) << a << ", " << b;
        }
    }
}

TEST(Random, NumbersOfNeighbouringPixelsFramesSeedsAndDimensionsAreUniformAndIndependent) {
    EXPECT_GT(worst_neighbours_p_value(hash_pcg4d), sidak_threshold(SIGNIFICANCE, 64));
}

TEST(Random, NegativeControlTheSameTestRejectsAHashThatForgetsItsSecondRound) {
    const Hash one_round = [](uvec4 v) {
        v = v * 1664525u + uvec4(1013904223u);
        v.x += v.y * v.w;
        v.y += v.z * v.x;
        v.z += v.x * v.y;
        v.w += v.y * v.z;
        return v;
    };
    EXPECT_LT(worst_neighbours_p_value(one_round), sidak_threshold(SIGNIFICANCE, 64));
}

// Share of the answer's bits that flip with bit `bit` of key word `word`.
double flipped_share(int word, int bit) {
    constexpr int KEY_COUNT = 1024;
    int flipped = 0;
    for (uint key = 0; key < uint(KEY_COUNT); ++key) {
        const uvec4 before(key, key * 7u, key * 31u, key * 127u);
        uvec4 after = before;
        after[word] ^= 1u << bit;
        const uvec4 change = hash_pcg4d(before) ^ hash_pcg4d(after);
        for (int i = 0; i < 4; ++i) flipped += std::popcount(change[i]);
    }
    return flipped / (KEY_COUNT * 128.0);
}

TEST(Random, FlippingOneOfTheLowBitsOfTheKeyFlipsHalfOfTheAnswer) {
    for (int word = 0; word < 4; ++word) {
        for (int bit = 0; bit < 12; ++bit)
            EXPECT_NEAR(flipped_share(word, bit), 0.5, 0.02) << word << ", " << bit;
    }
}

TEST(Random, FlippingOneOfTheHighBitsOfTheKeyFlipsAFifthOfTheAnswerAtLeast) {
    // Products carry only upwards, so the top bits of a key reach the low half of a word through one shift
    // alone.
    for (int word = 0; word < 4; ++word) {
        for (int bit = 12; bit < 32; ++bit) EXPECT_GT(flipped_share(word, bit), 0.2) << word << ", " << bit;
    }
}

TEST(RandomCoverage, IsTheSameForTheSameLayerOfTheSameRay) {
    const RandomKey key{77u, 5u, 9u};
    EXPECT_EQ(random_coverage(key, RAY_CAMERA, 3u, 4u), random_coverage(key, RAY_CAMERA, 3u, 4u));
    EXPECT_NE(random_coverage(key, RAY_CAMERA, 3u, 4u), random_coverage(key, RAY_SHADOW, 3u, 4u));
    EXPECT_NE(random_coverage(key, RAY_CAMERA, 3u, 4u), random_coverage(key, RAY_CAMERA, 4u, 3u));
}

TEST(RandomCoverage, IsUniformAndIndependentBetweenRaysLayersFramesAndPixels) {
    Histogram rays(16, 16), instances(16, 16), primitives(16, 16), frames(16, 16), pixels(16, 16);
    for (uint i = 0; i < uint(DRAW_COUNT); ++i) {
        const RandomKey key{i, 4u, 1u};
        const double u = random_coverage(key, RAY_CAMERA, 10u, 20u);
        rays.add(u, random_coverage(key, RAY_SHADOW, 10u, 20u));
        instances.add(u, random_coverage(key, RAY_CAMERA, 11u, 20u));
        primitives.add(u, random_coverage(key, RAY_CAMERA, 10u, 21u));
        frames.add(u, random_coverage({i, 5u, 1u}, RAY_CAMERA, 10u, 20u));
        pixels.add(random_coverage({2u * i, 4u, 1u}, RAY_CAMERA, 10u, 20u),
                   random_coverage({2u * i + 1u, 4u, 1u}, RAY_CAMERA, 10u, 20u));
    }
    for (const Histogram* h : {&rays, &instances, &primitives, &frames, &pixels}) {
        EXPECT_GT(h->uniform_p_value(), sidak_threshold(SIGNIFICANCE, 5));
    }
}

TEST(RandomCoverage, IsUniformOverTheLayersOfOneRay) {
    Histogram histogram(16, 16);
    for (uint instance = 0; instance < 256u; ++instance) {
        for (uint primitive = 0; primitive < 512u; primitive += 2u) {
            histogram.add(random_coverage({9u, 9u, 9u}, RAY_CAMERA, instance, primitive),
                          random_coverage({9u, 9u, 9u}, RAY_CAMERA, instance, primitive + 1u));
        }
    }
    EXPECT_GT(histogram.uniform_p_value(), SIGNIFICANCE);
}

}  // namespace
}  // namespace tarn
