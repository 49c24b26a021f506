// Void and cluster: every choice against energies that are summed up anew in double precision; ranks;
// determinism.
#include "blue_noise/void_and_cluster.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <thread>
#include <vector>

namespace tarn::noise {
namespace {

constexpr MaskSize FLAT = {32, 32, 1};
constexpr MaskSize SMALL = {32, 32, 4};
// What ties are broken by, rounding, and the far end of the Gaussian that the generator leaves out.
constexpr double TOLERANCE = 0.004;

int count_texels(const MaskSize& size) {
    return size.width * size.height * size.slices;
}

double squared_distance(int a, int b, int period) {
    const int d = std::abs(a - b);
    return double(std::min(d, period - d)) * std::min(d, period - d);
}

// The energy between two texels as the papers define it, weighed by the first coordinate where there is one.
double energy_between(const MaskSize& size, const Ranks* first, int a, int b) {
    const int area = size.width * size.height;
    const int pixel_a = a % area, pixel_b = b % area;
    double exponent = 0;
    if (a / area == b / area) {
        const double squares = squared_distance(pixel_a % size.width, pixel_b % size.width, size.width) +
                               squared_distance(pixel_a / size.width, pixel_b / size.width, size.height);
        exponent = squares / (2.0 * 1.9 * 1.9);
    } else if (pixel_a == pixel_b) {
        exponent = squared_distance(a / area, b / area, size.slices) / (2.0 * 1.9 * 1.9);
    } else {
        return 0.0;
    }
    double weight = 1.0;
    if (first != nullptr) {
        const double d = std::abs(double((*first)[a]) - double((*first)[b])) / area;
        weight = 1.0 + 6.0 * (d * d - d + 1.0 / 6.0);
    }
    return weight * std::exp(-exponent);
}

// Which sixteenth of the first coordinate a texel lies in; 0 without one.
int find_stratum(const MaskSize& size, const Ranks* first, int texel) {
    return first == nullptr ? 0 : (*first)[texel] * 16 / (size.width * size.height);
}

using Texels = std::vector<int>;

std::vector<Texels> list_texels_of_ranks(const MaskSize& size, const Ranks& ranks) {
    std::vector<Texels> texels(size.width * size.height);
    for (int texel = 0; texel < count_texels(size); ++texel) texels[ranks[texel]].push_back(texel);
    return texels;
}

// By how much `chosen` missed the largest void of its slice, among pixels that are not `closed` and strata
// that the sixteen ranks around its own have not met.
double find_miss(const MaskSize& size, const Ranks& ranks, const Ranks* first,
                 const std::vector<double>& energies, const std::set<int>& closed, int chosen) {
    const int area = size.width * size.height, begin = chosen / area * area, rank = ranks[chosen];
    std::set<int> met;
    for (int texel = begin; first != nullptr && texel < begin + area; ++texel) {
        if (ranks[texel] >= rank / 16 * 16 && ranks[texel] < rank)
            met.insert(find_stratum(size, first, texel));
    }
    double miss = 0;
    for (int texel = begin; texel < begin + area; ++texel) {
        if (ranks[texel] <= rank || closed.count(texel - begin) ||
            met.count(find_stratum(size, first, texel)))
            continue;
        miss = std::max(miss, energies[chosen] - energies[texel]);
    }
    return miss;
}

// The worst miss of all ranks behind the first tenth. Of several slices the order within a rank is not known:
// energies are those before the rank, and pixels are left out that another slice may have taken at the same
// rank. The chosen one had at least its own energy then.
double find_worst_choice(const MaskSize& size, const Ranks& ranks, const Ranks* first = nullptr) {
    const int area = size.width * size.height, count = count_texels(size);
    const std::vector<Texels> texels_of_rank = list_texels_of_ranks(size, ranks);
    std::vector<double> energies(count, 0.0);
    double worst = 0;
    for (int rank = 0; rank < area; ++rank) {
        std::set<int> closed;
        for (const int texel : texels_of_rank[rank]) closed.insert(texel % area);
        for (const int texel : texels_of_rank[rank]) {
            if (rank >= area / 10)
                worst = std::max(worst, find_miss(size, ranks, first, energies, closed, texel));
        }
        for (const int set : texels_of_rank[rank]) {
            for (int texel = 0; texel < count; ++texel)
                energies[texel] += energy_between(size, first, set, texel);
        }
    }
    return worst;
}

// The first pattern of a flat mask: the texels of the first 96 ranks, which is a tenth in whole blocks of
// sixteen.
constexpr int FIRST_COUNT = 96;

// Energies at all texels of a flat mask from those of ranks up to `last`.
std::vector<double> sum_energies(const Ranks& ranks, const Ranks* first, int last) {
    std::vector<double> energies(ranks.size(), 0.0);
    for (int set = 0; set < int(ranks.size()); ++set) {
        for (int texel = 0; ranks[set] <= last && texel < int(ranks.size()); ++texel)
            energies[texel] += energy_between(FLAT, first, set, texel);
    }
    return energies;
}

// By how much the ranks of the first pattern miss the tightest cluster among those up to them, at worst.
double find_worst_first_choice(const Ranks& ranks, const Ranks* first = nullptr) {
    const std::vector<Texels> texels = list_texels_of_ranks(FLAT, ranks);
    double worst = 0;
    for (int rank = 0; rank < FIRST_COUNT; ++rank) {
        const std::vector<double> energies = sum_energies(ranks, first, rank);
        std::set<int> met;
        for (int later = rank + 1; first != nullptr && later % 16 != 0; ++later)
            met.insert(find_stratum(FLAT, first, texels[later][0]));
        for (int other = 0; other < rank; ++other) {
            if (met.count(find_stratum(FLAT, first, texels[other][0]))) continue;
            worst = std::max(worst, energies[texels[other][0]] - energies[texels[rank][0]]);
        }
    }
    return worst;
}

// What the texel of the first pattern's tightest cluster would gain by a move to the largest void.
double find_gain_of_a_move(const Ranks& ranks) {
    const std::vector<double> energies = sum_energies(ranks, nullptr, FIRST_COUNT - 1);
    int tightest = -1;
    for (int texel = 0; texel < int(ranks.size()); ++texel) {
        if (ranks[texel] >= FIRST_COUNT) continue;
        if (tightest < 0 || energies[texel] > energies[tightest]) tightest = texel;
    }
    double gain = 0;
    for (int texel = 0; texel < int(ranks.size()); ++texel) {
        if (ranks[texel] < FIRST_COUNT) continue;
        const double there = energies[texel] - energy_between(FLAT, nullptr, tightest, texel);
        gain = std::max(gain, energies[tightest] - 1.0 - there);
    }
    return gain;
}

TEST(VoidAndCluster, TheFirstPatternIsEven) {
    EXPECT_LT(find_gain_of_a_move(make_blue_noise(FLAT, 5)), TOLERANCE);
    Ranks random(1024);
    for (int i = 0; i < 1024; ++i) random[i] = std::uint16_t(i * 7919 % 1024 * 31 % 1021);
    EXPECT_GT(find_gain_of_a_move(random), 50 * TOLERANCE);
}

TEST(VoidAndCluster, TheFirstPatternIsTakenApartFromItsTightestClusters) {
    const Ranks first = make_blue_noise(FLAT, 5), second = make_second_coordinate(FLAT, first, 6);
    EXPECT_LT(find_worst_first_choice(first), TOLERANCE);
    EXPECT_LT(find_worst_first_choice(second, &first), TOLERANCE);
    Ranks reversed = first;
    for (std::uint16_t& rank : reversed) {
        if (rank < FIRST_COUNT) rank = std::uint16_t(FIRST_COUNT - 1 - rank);
    }
    EXPECT_GT(find_worst_first_choice(reversed), 5 * TOLERANCE);
}

TEST(VoidAndCluster, EachRankGoesToTheLargestVoid) {
    EXPECT_LT(find_worst_choice(FLAT, make_blue_noise(FLAT, 5)), TOLERANCE);
}

TEST(VoidAndCluster, OverTimeToo) {
    EXPECT_LT(find_worst_choice(SMALL, make_blue_noise(SMALL, 5)), TOLERANCE);
}

TEST(VoidAndCluster, TheSecondCoordinateCountsEnergyByTheFirst) {
    const Ranks first = make_blue_noise(FLAT, 5), second = make_second_coordinate(FLAT, first, 6);
    EXPECT_LT(find_worst_choice(FLAT, second, &first), TOLERANCE);
}

TEST(VoidAndCluster, NegativeControlsFail) {
    const Ranks first = make_blue_noise(FLAT, 5);
    EXPECT_GT(find_worst_choice(FLAT, make_blue_noise(FLAT, 6), &first), 50 * TOLERANCE) << "not coupled";
    EXPECT_GT(find_worst_choice(FLAT, make_second_coordinate(FLAT, first, 6)), 50 * TOLERANCE) << "coupled";
    Ranks later = first;
    for (std::uint16_t& rank : later) {
        if (rank == 300 || rank == 305) rank = std::uint16_t(605 - rank);
    }
    EXPECT_GT(find_worst_choice(FLAT, later), 5 * TOLERANCE) << "two ranks exchanged";
    Ranks alone;  // four slices that know nothing of each other
    for (std::uint32_t slice = 0; slice < 4; ++slice) {
        const Ranks ranks = make_blue_noise(FLAT, slice);
        alone.insert(alone.end(), ranks.begin(), ranks.end());
    }
    EXPECT_GT(find_worst_choice(SMALL, alone), 50 * TOLERANCE) << "space alone";
}

TEST(VoidAndCluster, EachRankStandsOnceInEachSlice) {
    const Ranks first = make_blue_noise(SMALL, 1);
    for (const Ranks& ranks : {first, make_second_coordinate(SMALL, first, 2)}) {
        for (int slice = 0; slice < 4; ++slice) {
            const std::set<int> found(ranks.begin() + slice * 1024, ranks.begin() + (slice + 1) * 1024);
            EXPECT_EQ(found.size(), 1024u);
            EXPECT_EQ(*found.rbegin(), 1023);
        }
    }
}

// How many blocks of sixteen ranks of a slice do not have one texel in each sixteenth of the first
// coordinate.
int count_uneven_blocks(const Ranks& first, const Ranks& second) {
    std::vector<std::set<int>> strata(4 * 64);
    for (int texel = 0; texel < count_texels(SMALL); ++texel)
        strata[texel / 1024 * 64 + second[texel] / 16].insert(find_stratum(SMALL, &first, texel));
    return int(std::count_if(strata.begin(), strata.end(), [](const auto& met) { return met.size() != 16; }));
}

TEST(VoidAndCluster, SixteenRanksOfTheSecondCoordinateAreInAllSixteenthsOfTheFirst) {
    const Ranks first = make_blue_noise(SMALL, 1);
    EXPECT_EQ(count_uneven_blocks(first, make_second_coordinate(SMALL, first, 2)), 0);
    EXPECT_GT(count_uneven_blocks(first, make_blue_noise(SMALL, 2)), 200) << "an independent mask";
}

TEST(VoidAndCluster, TheSameSeedGivesTheSameRanksInAnyThread) {
    const Ranks expected = make_blue_noise(SMALL, 7);
    Ranks results[2];
    {
        std::jthread one([&] { results[0] = make_blue_noise(SMALL, 7); });
        std::jthread two([&] { results[1] = make_blue_noise(SMALL, 7); });
    }
    EXPECT_EQ(results[0], expected);
    EXPECT_EQ(results[1], expected);
    EXPECT_NE(make_blue_noise(SMALL, 8), expected);
}

}  // namespace
}  // namespace tarn::noise
