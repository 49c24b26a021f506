// Alias tables: the builder's probabilities by enumeration, draws by chi-square, index choice at its edges.
#include "shared/math/alias_table.h"

#include <gtest/gtest.h>

#include <limits>

#include "core/statistics.h"
#include "shared/math/random.h"
#include "support/draws.h"
#include "support/histogram.h"
#include "world/alias_builder.h"

namespace tarn {
namespace {

using test::Draws;
using test::SIGNIFICANCE;

// Probability of each index, summed over the buckets that lead to it.
std::vector<double> enumerate_table(const AliasTable& table) {
    std::vector<double> probability(table.rows.size());
    for (std::size_t i = 0; i < table.rows.size(); ++i) {
        const AliasBucket bucket = unpack_alias_bucket(table.rows[i]);
        probability[i] += bucket.threshold / double(table.rows.size());
        probability[bucket.alias] += (1.0 - bucket.threshold) / double(table.rows.size());
    }
    return probability;
}

std::vector<double> random_weights(int count, std::uint64_t seed) {
    Draws draws(seed);
    std::vector<double> weights(static_cast<std::size_t>(count));
    for (double& w : weights) w = std::pow(10.0, draws.uniform(-3.0, 3.0));
    return weights;
}

void expect_probabilities(const std::vector<double>& weights) {
    const AliasTable table = build_alias_table(weights);
    ASSERT_EQ(table.rows.size(), weights.size());
    ASSERT_EQ(table.pmf.size(), weights.size());
    double sum = 0.0;
    for (const double w : weights) sum += w;
    const std::vector<double> probability = enumerate_table(table);
    for (std::size_t i = 0; i < weights.size(); ++i) {
        // What is drawn is what the table says is drawn.
        EXPECT_NEAR(table.pmf[i], probability[i], 1e-7 * probability[i]) << i;
        // Thresholds are rounded up to the grid of the random numbers: 2^-24 of each bucket at most.
        EXPECT_NEAR(probability[i], weights[i] / sum, 0x1p-24) << i;
    }
}

TEST(AliasTable, EnumerationOfItsBucketsGivesTheWeights) {
    expect_probabilities({1.0});
    expect_probabilities({1.0, 1.0, 1.0});
    expect_probabilities({1.0, 2.0, 3.0, 4.0});
    expect_probabilities({0.0, 1.0, 0.0, 0.0, 5.0});
    expect_probabilities({1e-300, 1e-300});
    expect_probabilities(random_weights(1000, 1));
}

TEST(AliasTable, ADimWeightIsDrawnAsOftenAsItsProbabilitySays) {
    std::vector<double> weights(1000, 1.0);
    weights[500] = 1e-10;
    const AliasTable table = build_alias_table(weights);
    const AliasBucket bucket = unpack_alias_bucket(table.rows[500]);
    // Of the 2^24 values of u in [0, 1), those below the threshold.
    const double drawn = std::ceil(bucket.threshold * 0x1p24) * 0x1p-24 / 1000.0;
    EXPECT_GT(drawn, 0.0);
    EXPECT_NEAR(table.pmf[500], drawn, 1e-7 * drawn);
}

TEST(AliasTable, OneWeightThatOutshinesAMillionOthersKeepsItsShare) {
    std::vector<double> weights(1'000'000, 1.0);
    weights[777'777] = 1e6;
    const std::vector<double> probability = enumerate_table(build_alias_table(weights));
    EXPECT_NEAR(probability[777'777], 1e6 / (1e6 + 999'999.0), 1e-6);
}

TEST(AliasTable, EachBucketCarriesTheProbabilityOfBothItsIndices) {
    const AliasTable table = build_alias_table(random_weights(100, 2));
    for (std::size_t i = 0; i < table.rows.size(); ++i) {
        const AliasBucket bucket = unpack_alias_bucket(table.rows[i]);
        EXPECT_EQ(bucket.pmf_own, table.pmf[i]);
        EXPECT_EQ(bucket.pmf_alias, table.pmf[bucket.alias]);
    }
}

TEST(AliasTable, WeightsThatAreZeroNegativeOrNotFiniteAreNeverDrawn) {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const double infinity = std::numeric_limits<double>::infinity();
    const AliasTable table = build_alias_table(std::vector<double>{0.0, 1.0, nan, -5.0, infinity, 3.0});
    const std::vector<double> probability = enumerate_table(table);
    for (const int dead : {0, 2, 3, 4}) {
        EXPECT_EQ(probability[std::size_t(dead)], 0.0) << dead;
        EXPECT_EQ(table.pmf[std::size_t(dead)], 0.0f) << dead;
    }
    EXPECT_FLOAT_EQ(table.pmf[1], 0.25f);
}

TEST(AliasTable, WithoutAnyWeightItIsUniformAndWithoutEntriesItIsEmpty) {
    for (const float p : build_alias_table(std::vector<double>(4, 0.0)).pmf) EXPECT_EQ(p, 0.25f);
    EXPECT_TRUE(build_alias_table(std::vector<double>{}).rows.empty());
}

// p value of "draws through the table follow `weights`".
double draws_p_value(const AliasTable& table, const std::vector<double>& weights) {
    constexpr int DRAW_COUNT = 500'000;
    std::vector<double> observed(weights.size());
    std::vector<double> expected(weights.size());
    double sum = 0.0;
    for (const double w : weights) sum += w;
    for (std::size_t i = 0; i < weights.size(); ++i) expected[i] = weights[i] / sum * DRAW_COUNT;
    for (uint i = 0; i < uint(DRAW_COUNT); ++i) {
        const uvec4 bits = random_bits4({i, 0u, 5u}, DIMENSION_CANDIDATE);
        const uint bucket = uniform_index(bits.x, uint(weights.size()));
        const DiscreteSample drawn =
            resolve_alias(unpack_alias_bucket(table.rows[bucket]), bucket, float_from_bits(bits.y));
        EXPECT_EQ(drawn.pmf, table.pmf[drawn.index]);
        ++observed[drawn.index];
    }
    return chi_square_test(observed, expected).p_value;
}

TEST(AliasTable, DrawsFollowTheWeightsAndReportTheirProbability) {
    for (const int count : {1, 2, 17, 500}) {
        const std::vector<double> weights = random_weights(count, 3);
        EXPECT_GT(draws_p_value(build_alias_table(weights), weights), sidak_threshold(SIGNIFICANCE, 4))
            << count;
    }
}

TEST(AliasTable, NegativeControlATableWithoutAliasesFails) {
    const std::vector<double> weights = random_weights(17, 3);
    AliasTable table = build_alias_table(weights);
    for (uint i = 0; i < table.rows.size(); ++i) {
        AliasBucket bucket = unpack_alias_bucket(table.rows[i]);
        bucket.alias = i;
        bucket.pmf_alias = bucket.pmf_own;
        table.rows[i] = pack_alias_bucket(bucket);
    }
    EXPECT_LT(draws_p_value(table, weights), SIGNIFICANCE);
}

TEST(AliasTable, ThresholdsZeroAndOneNeverTakeTheOtherIndex) {
    const float last = 1.0f - 0x1p-24f;
    EXPECT_EQ(resolve_alias({1.0f, 9u, 0.5f, 0.25f}, 4u, last).index, 4u);
    EXPECT_EQ(resolve_alias({0.0f, 9u, 0.0f, 0.25f}, 4u, 0.0f).index, 9u);
    EXPECT_EQ(resolve_alias({0.0f, 9u, 0.0f, 0.25f}, 4u, 0.0f).pmf, 0.25f);
}

TEST(UniformIndex, CoversAllIndicesAndNoMore) {
    for (const uint count : {1u, 2u, 3u, 1000u, 1'000'000u, 0xffffffffu}) {
        EXPECT_EQ(uniform_index(0u, count), 0u);
        EXPECT_EQ(uniform_index(0xffffffffu, count), count - 1u);
    }
    EXPECT_EQ(uniform_index(0x7fffffffu, 2u), 0u);
    EXPECT_EQ(uniform_index(0x80000000u, 2u), 1u);
}

TEST(UniformIndex, GivesEachOfAMillionIndicesTheSameNumberOfBitPatternsUpToOne) {
    constexpr std::uint64_t COUNT = 1'000'000;
    Draws draws(6);
    for (int i = 0; i < 1000; ++i) {
        // The first pattern of index k is the smallest x with x * COUNT >= k * 2^32.
        const std::uint64_t k = draws.bits() % COUNT;
        const std::uint64_t first = ((k << 32) + COUNT - 1) / COUNT;
        EXPECT_EQ(uniform_index(uint(first), uint(COUNT)), k);
        if (k > 0) {
            EXPECT_EQ(uniform_index(uint(first - 1), uint(COUNT)), k - 1);
        }
    }
}

}  // namespace
}  // namespace tarn
