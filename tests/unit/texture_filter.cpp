// Texture lookup: wrap modes against brute force, weights, and coordinates that nobody should ask for.
#include "shared/math/texture_filter.h"

#include <gtest/gtest.h>

#include <limits>

#include "support/draws.h"
#include "support/texture_oracle.h"

namespace tarn {
namespace {

using test::Draws;
using test::filter_by_definition;
using test::wrap_by_definition;

const uint WRAP_MODES[] = {WRAP_REPEAT, WRAP_CLAMP, WRAP_MIRROR};

TEST(WrapTexel, EqualsTheDefinitionNearZeroForAllSmallSizes) {
    for (const uint wrap : WRAP_MODES) {
        for (int size = 1; size <= 9; ++size) {
            for (int c = -40; c <= 40; ++c) {
                EXPECT_EQ(wrap_texel(c, size, wrap), wrap_by_definition(c, size, wrap))
                    << c << " of " << size;
            }
        }
    }
}

TEST(WrapTexel, EqualsTheDefinitionForHugeCoordinatesAndSizesThatAreNoPowersOfTwo) {
    Draws draws(1);
    for (const uint wrap : WRAP_MODES) {
        for (const int size : {1, 3, 100, 1023, 4096, 8191, 65535}) {
            for (int i = 0; i < 20'000; ++i) {
                int c = int(draws.bits() % 16'777'217u) - 8'388'608;
                // Every second one at the edge of a period, where a rounded quotient goes wrong first.
                if (i % 2 == 1) c = c / size * size - int(draws.bits() % 3u);
                EXPECT_EQ(wrap_texel(c, size, wrap), wrap_by_definition(c, size, wrap))
                    << c << " of " << size;
            }
        }
    }
}

TEST(WrapTexel, ATextureOfOneTexelIsThatTexelEverywhere) {
    for (const uint wrap : WRAP_MODES) {
        for (const int c : {-8'388'608, -7, -1, 0, 1, 2, 8'388'607}) EXPECT_EQ(wrap_texel(c, 1, wrap), 0);
    }
}

TEST(TexelFootprint, WeightsAreNotNegativeAndSumToOne) {
    Draws draws(2);
    for (int i = 0; i < 20'000; ++i) {
        const vec2 uv(float(draws.uniform(-5.0, 5.0)), float(draws.uniform(-5.0, 5.0)));
        const TexelFootprint f = texel_footprint(uv, ivec2(37, 12), WRAP_REPEAT, WRAP_MIRROR, i % 2 == 0);
        float sum = 0.0f;
        for (int k = 0; k < 4; ++k) {
            EXPECT_GE(f.weights[k], 0.0f);
            EXPECT_LT(f.indices[k], 37u * 12u);
            sum += f.weights[k];
        }
        EXPECT_NEAR(sum, 1.0f, 2e-7f);
    }
}

TEST(TexelFootprint, BilinearLookupEqualsTheDefinitionForAllPairsOfWrapModes) {
    const ivec2 size(5, 3);
    const auto texel = [](int x, int y) { return 1.0 + x * 7 % 5 + 10.0 * (y * 2 % 3); };
    Draws draws(3);
    for (const uint wrap_u : WRAP_MODES) {
        for (const uint wrap_v : WRAP_MODES) {
            for (int i = 0; i < 3000; ++i) {
                const vec2 uv(float(draws.uniform(-3.0, 3.0)), float(draws.uniform(-3.0, 3.0)));
                const TexelFootprint f = texel_footprint(uv, size, wrap_u, wrap_v, false);
                double value = 0.0;
                for (int k = 0; k < 4; ++k) {
                    const int index = int(f.indices[k]);
                    value += f.weights[k] * texel(index % size.x, index / size.x);
                }
                EXPECT_NEAR(value, filter_by_definition(uv, size, wrap_u, wrap_v, texel), 1e-4);
            }
        }
    }
}

TEST(TexelFootprint, AtATexelsCentreBilinearIsThatTexel) {
    const TexelFootprint f =
        texel_footprint(vec2(2.5f / 8.0f, 1.5f / 4.0f), ivec2(8, 4), WRAP_REPEAT, WRAP_REPEAT, false);
    EXPECT_EQ(f.indices.x, 1u * 8u + 2u);
    EXPECT_EQ(f.weights, vec4(1, 0, 0, 0));
}

TEST(TexelFootprint, NearestTakesTheTexelThatHoldsThePointAndItsLowerEdge) {
    for (int x = 0; x < 8; ++x) {
        for (const float inside : {0.0f, 0.25f, 0.9375f}) {
            const vec2 uv((float(x) + inside) / 8.0f, 0.3f);
            const TexelFootprint f = texel_footprint(uv, ivec2(8, 4), WRAP_REPEAT, WRAP_REPEAT, true);
            EXPECT_EQ(f.indices.x, 8u + uint(x));
            EXPECT_EQ(f.weights, vec4(1, 0, 0, 0));
        }
    }
    EXPECT_EQ(texel_footprint(vec2(1.0f), ivec2(8, 4), WRAP_CLAMP, WRAP_CLAMP, true).indices.x, 31u);
    EXPECT_EQ(texel_footprint(vec2(1.0f), ivec2(8, 4), WRAP_REPEAT, WRAP_REPEAT, true).indices.x, 0u);
    EXPECT_EQ(texel_footprint(vec2(1.0f), ivec2(8, 4), WRAP_MIRROR, WRAP_MIRROR, true).indices.x, 31u);
}

TEST(TexelFootprint, NanInfiniteAndHugeCoordinatesGiveSomeTexelOfTheTexture) {
    const float nan = std::numeric_limits<float>::quiet_NaN();
    const float infinity = std::numeric_limits<float>::infinity();
    const float wild[] = {nan, infinity, -infinity, 1e30f, -1e30f, 8388608.0f, -8388608.0f, 3.4e38f};
    for (const uint wrap : WRAP_MODES) {
        for (const bool nearest : {false, true}) {
            for (const float u : wild) {
                for (const float v : wild) {
                    const TexelFootprint f = texel_footprint(vec2(u, v), ivec2(7, 3), wrap, wrap, nearest);
                    float sum = 0.0f;
                    for (int k = 0; k < 4; ++k) {
                        EXPECT_LT(f.indices[k], 21u);
                        sum += f.weights[k];
                    }
                    EXPECT_EQ(sum, 1.0f);
                }
            }
        }
    }
}

}  // namespace
}  // namespace tarn
