// Void and cluster over space and time, for one coordinate and for two.
//
// Ulichney ("The void-and-cluster method for dither array generation", 1993) fills a mask texel by texel.
// Each texel that is set spreads a Gaussian of energy; the next rank goes to the free texel with the least
// energy, the largest void. So the texels below any rank are spread evenly. Wolfe et al. ("Spatiotemporal
// Blue Noise Masks", EGSR 2022) let energy pass only between texels of one slice and between the times of one
// pixel: each slice is blue, and so is each pixel's sequence. Here every slice takes its next rank in turn,
// so that each rank stands exactly once in each slice.
//
// Ulichney's third phase, for ranks above one half, looks for the tightest cluster of free texels. All texels
// together give nearly the same energy everywhere, so that this cluster is the largest void among the set
// ones: one loop does both.
//
// The second coordinate. What shall be small is the blurred error of integrands over (u, v). Two independent
// masks give blue error for f(u) + g(v), but white noise for what depends on both. So the energy between two
// texels is the Gaussian times 1 + 6 B(u1 - u2), B the periodic Bernoulli polynomial d^2 - d + 1/6: a product
// kernel, as measures of discrepancy have it (Hickernell 1998). The 1 is blue noise of v alone, the rest that
// of pairs. Below 6 the pairs are whiter, above it v alone is worse.
//
// Energy is local: it does not see whether all pairs together fill the square. Therefore strata: of STRATA
// successive ranks of v, each goes to another range of u. Every slice then has as many points in each box of
// a grid.
#include "blue_noise/void_and_cluster.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/error.h"
#include "shared/math/random.h"

namespace tarn::noise {
namespace {

// Energies are whole numbers: setting a texel and clearing it again leaves no trace, and libm's last bit does
// not matter.
constexpr int WEIGHT_ONE = 1 << 16;
constexpr int COUPLING_BITS = 13;  // the product of the two fits
// Ties would go to the first texel and leave a pattern. A little energy that each texel has by itself breaks
// them.
constexpr uint TIE_MASK = 15u;
// One texel in so many belongs to the first pattern, which is made even before ranks are given.
constexpr int FIRST_SHARE = 10;
constexpr int DIAMETER = 2 * ENERGY_RADIUS_PX + 1;
constexpr uint ANY_STRATUM = ~0u;

// What a random number is for.
enum Purpose : uint { TIE, FIRST_PATTERN };

int to_weight(double distance, double sigma) {
    return int(std::lround(WEIGHT_ONE * std::exp(-distance * distance / (2.0 * sigma * sigma))));
}

class VoidAndCluster {
  public:
    // Without `first` the mask is for one coordinate.
    VoidAndCluster(const MaskSize& size, std::uint32_t seed, const Ranks* first);
    Ranks make();

  private:
    using Set = std::vector<std::uint8_t>;

    void set_weights();
    void set_coupling(const Ranks& first);
    void draw_first_pattern();
    void even_out_first_pattern();
    void rank_first_pattern(Ranks& ranks);
    void change(int slice, int texel, int sign);
    void spread_in_slice(int slice, int texel, int sign);
    void spread_over_time(int slice, int texel, int sign);
    int weigh(int weight, int here, int there) const;
    int find_tightest_cluster(int slice, uint strata) const;
    int find_largest_void(int slice, uint strata) const;
    void close_stratum(int slice, int texel);
    int index(int slice, int texel) const { return slice * area_ + texel; }
    uint random_bits(Purpose purpose, uint a, uint b) const {
        return hash_pcg4d(uvec4(a, b, seed_, purpose)).x;
    }

    MaskSize size_;
    int area_;
    int first_count_;
    uint seed_;
    std::vector<int> energies_;
    Set is_set_;
    std::vector<int> weights_px_;      // DIAMETER x DIAMETER
    std::vector<int> weights_slices_;  // by distance in slices
    Ranks first_;                      // of the first coordinate; empty: none
    std::vector<int> coupling_;        // by difference of ranks of the first coordinate
    std::vector<uint> strata_;  // of each texel: one bit; all the same where there is no first coordinate
    uint all_strata_ = 1u;
    std::vector<uint> open_strata_;  // of each slice: those that the present ranks have not met
};

VoidAndCluster::VoidAndCluster(const MaskSize& size, std::uint32_t seed, const Ranks* first)
    : size_(size),
      area_(size.width * size.height),
      first_count_(area_ / FIRST_SHARE / STRATA * STRATA),
      seed_(seed) {
    const auto fits = [](int n) { return n >= 32 && (n & (n - 1)) == 0; };
    TARN_ASSERT(fits(size.width) && fits(size.height) && size.slices >= 1 && area_ <= 65536, "{} x {} x {}",
                size.width, size.height, size.slices);
    const int count = area_ * size.slices;
    set_weights();
    strata_.assign(count, 1u);
    if (first != nullptr) set_coupling(*first);
    open_strata_.assign(size.slices, all_strata_);
    is_set_.assign(count, 0);
    for (int i = 0; i < count; ++i) energies_.push_back(int(random_bits(TIE, uint(i), 0u) & TIE_MASK));
}

void VoidAndCluster::set_weights() {
    for (int y = -ENERGY_RADIUS_PX; y <= ENERGY_RADIUS_PX; ++y) {
        for (int x = -ENERGY_RADIUS_PX; x <= ENERGY_RADIUS_PX; ++x)
            weights_px_.push_back(to_weight(std::hypot(x, y), ENERGY_SIGMA_PX));
    }
    for (int t = 0; t < size_.slices; ++t)
        weights_slices_.push_back(to_weight(std::min(t, size_.slices - t), ENERGY_SIGMA_SLICES));
}

void VoidAndCluster::set_coupling(const Ranks& first) {
    TARN_ASSERT(first.size() == strata_.size(), "{} ranks", first.size());
    first_ = first;
    for (int difference = 0; difference < area_; ++difference) {
        const double d = double(std::min(difference, area_ - difference)) / area_;
        coupling_.push_back(int(std::lround((1 << COUPLING_BITS) * (1.0 + 6.0 * (d * d - d + 1.0 / 6.0)))));
    }
    for (std::size_t i = 0; i < first.size(); ++i) strata_[i] = 1u << (first[i] * STRATA / area_);
    all_strata_ = (1u << STRATA) - 1u;
}

Ranks VoidAndCluster::make() {
    Ranks ranks(is_set_.size());
    draw_first_pattern();
    even_out_first_pattern();
    rank_first_pattern(ranks);
    for (int rank = first_count_; rank < area_; ++rank) {
        for (int slice = 0; slice < size_.slices; ++slice) {
            const int texel = find_largest_void(slice, open_strata_[slice]);
            change(slice, texel, 1);
            close_stratum(slice, texel);
            ranks[index(slice, texel)] = std::uint16_t(rank);
        }
    }
    return ranks;
}

void VoidAndCluster::draw_first_pattern() {
    for (int slice = 0; slice < size_.slices; ++slice) {
        int count = 0;
        for (uint draw = 0; count < first_count_; ++draw) {
            const int texel = int(random_bits(FIRST_PATTERN, draw, uint(slice)) % uint(area_));
            const int here = index(slice, texel);
            if (is_set_[here] || !(strata_[here] & open_strata_[slice])) continue;
            change(slice, texel, 1);
            close_stratum(slice, texel);
            ++count;
        }
    }
}

// Moves the texel of the tightest cluster into the largest void of its stratum until that is where it was. It
// ends: a move takes energy away, or keeps it and goes to an earlier texel.
void VoidAndCluster::even_out_first_pattern() {
    for (bool moved = true; moved;) {
        moved = false;
        for (int slice = 0; slice < size_.slices; ++slice) {
            const int from = find_tightest_cluster(slice, ANY_STRATUM);
            change(slice, from, -1);
            const int to = find_largest_void(slice, strata_[index(slice, from)]);
            change(slice, to, 1);
            moved = moved || from != to;
        }
    }
}

// Takes the pattern apart, tightest cluster first, which gets the highest rank; and puts it back.
void VoidAndCluster::rank_first_pattern(Ranks& ranks) {
    const Set pattern = is_set_;
    const std::vector<int> energies = energies_;
    for (int rank = first_count_ - 1; rank >= 0; --rank) {
        for (int slice = 0; slice < size_.slices; ++slice) {
            const int texel = find_tightest_cluster(slice, open_strata_[slice]);
            change(slice, texel, -1);
            close_stratum(slice, texel);
            ranks[index(slice, texel)] = std::uint16_t(rank);
        }
    }
    is_set_ = pattern;
    energies_ = energies;
}

// Sets (sign 1) or clears (-1) a texel.
void VoidAndCluster::change(int slice, int texel, int sign) {
    spread_in_slice(slice, texel, sign);
    spread_over_time(slice, texel, sign);
    is_set_[index(slice, texel)] = sign > 0;
}

int VoidAndCluster::weigh(int weight, int here, int there) const {
    if (first_.empty()) return weight;
    return weight * coupling_[(first_[here] - first_[there]) & (area_ - 1)] >> COUPLING_BITS;
}

void VoidAndCluster::spread_in_slice(int slice, int texel, int sign) {
    const int texel_x = texel % size_.width, texel_y = texel / size_.width;
    const int* weight = weights_px_.data();
    for (int y = -ENERGY_RADIUS_PX; y <= ENERGY_RADIUS_PX; ++y) {
        const int row = index(slice, ((texel_y + y) & (size_.height - 1)) * size_.width);
        for (int x = -ENERGY_RADIUS_PX; x <= ENERGY_RADIUS_PX; ++x, ++weight) {
            const int other = row + ((texel_x + x) & (size_.width - 1));
            energies_[other] += sign * weigh(*weight, index(slice, texel), other);
        }
    }
}

void VoidAndCluster::spread_over_time(int slice, int texel, int sign) {
    for (int t = 1; t < size_.slices; ++t) {
        const int other = index((slice + t) % size_.slices, texel);
        energies_[other] += sign * weigh(weights_slices_[t], index(slice, texel), other);
    }
}

int VoidAndCluster::find_tightest_cluster(int slice, uint strata) const {
    int best = 0, most = std::numeric_limits<int>::min();
    for (int texel = 0; texel < area_; ++texel) {
        const int here = index(slice, texel);
        if (!is_set_[here] || !(strata_[here] & strata) || energies_[here] <= most) continue;
        most = energies_[here];
        best = texel;
    }
    return best;
}

int VoidAndCluster::find_largest_void(int slice, uint strata) const {
    int best = 0, least = std::numeric_limits<int>::max();
    for (int texel = 0; texel < area_; ++texel) {
        const int here = index(slice, texel);
        if (is_set_[here] || !(strata_[here] & strata) || energies_[here] >= least) continue;
        least = energies_[here];
        best = texel;
    }
    return best;
}

// The texel's stratum has its rank. Once all have one, all are open again.
void VoidAndCluster::close_stratum(int slice, int texel) {
    open_strata_[slice] &= ~strata_[index(slice, texel)];
    if (open_strata_[slice] == 0u) open_strata_[slice] = all_strata_;
}

}  // namespace

Ranks make_blue_noise(const MaskSize& size, std::uint32_t seed) {
    return VoidAndCluster(size, seed, nullptr).make();
}

Ranks make_second_coordinate(const MaskSize& size, const Ranks& first, std::uint32_t seed) {
    return VoidAndCluster(size, seed, &first).make();
}

}  // namespace tarn::noise
