// Tile sums of images, their moments over seeds, and the pooled, skewness-corrected Welch test of two sides.
#include "support/tile_test.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include "core/error.h"
#include "core/statistics.h"
#include "shared/math/colour.h"
#include "support/goodness_of_fit.h"

namespace tarn {
namespace {

constexpr int CHANNELS = 4;  // R, G, B, luminance
constexpr int LUMINANCE_CHANNEL = 3;
constexpr double LUMINANCE[3] = {LUMINANCE_WEIGHTS};
// Skewness of a tile's mean above which Hall's transformation is no longer trusted: about 1 / skewness^2 rare
// events.
constexpr double MAX_SKEWNESS = 0.25;

// Square of tiles: `x`, `y` in units of its own size, which is `size` tiles.
struct Block {
    int x = 0;
    int y = 0;
    int size = 1;
};

// Cumulants of the mean over a block.
struct Moments {
    double mean = 0;
    double variance = 0;
    double third_cumulant = 0;
    double degrees_of_freedom = std::numeric_limits<double>::infinity();
};

using MomentsOf = std::function<Moments(const Block&, int channel)>;

struct Grid {
    int width_px = 0;
    int height_px = 0;
    int tile_size_px = 1;

    int columns() const { return (width_px + tile_size_px - 1) / tile_size_px; }
    int rows() const { return (height_px + tile_size_px - 1) / tile_size_px; }
    std::size_t sum_count() const { return std::size_t(columns()) * rows() * CHANNELS; }

    double pixel_count(const Block& block) const {
        const int edge = block.size * tile_size_px;
        return double(std::min(width_px - block.x * edge, edge)) * std::min(height_px - block.y * edge, edge);
    }

    double sum(const std::vector<double>& tile_sums, const Block& block, int channel) const {
        double total = 0;
        for (int y = block.y * block.size; y < std::min((block.y + 1) * block.size, rows()); ++y) {
            for (int x = block.x * block.size; x < std::min((block.x + 1) * block.size, columns()); ++x) {
                total += tile_sums[(std::size_t(y) * columns() + x) * CHANNELS + channel];
            }
        }
        return total;
    }
};

bool is_finite(const float* rgb) {
    return std::isfinite(rgb[0]) && std::isfinite(rgb[1]) && std::isfinite(rgb[2]);
}

double luminance_of_means(const float* rgb) {
    return LUMINANCE[0] * rgb[0] + LUMINANCE[1] * rgb[1] + LUMINANCE[2] * rgb[2];
}

// The channels of one path rise and fall together: full correlation is the bound that never claims too much.
double luminance_of_variances(const float* variance) {
    double deviation = 0;
    for (int c = 0; c < 3; ++c) deviation += LUMINANCE[c] * std::sqrt(std::max(double(variance[c]), 0.0));
    return deviation * deviation;
}

// Sums R, G, B and `fourth` of each tile's finite pixels; adds the number of other pixels to `non_finite`.
std::vector<double> sum_tiles(const Grid& grid, const Image& image, double (*fourth)(const float*),
                              std::size_t& non_finite) {
    TARN_ASSERT(image.channels == 3 && image.width == grid.width_px && image.height == grid.height_px,
                "image is {} x {} x {}, {} x {} x 3 is needed", image.width, image.height, image.channels,
                grid.width_px, grid.height_px);
    std::vector<double> sums(grid.sum_count(), 0.0);
    for (int y = 0; y < image.height; ++y) {
        for (int x = 0; x < image.width; ++x) {
            const float* rgb = image.pixel(x, y);
            if (!is_finite(rgb)) {
                ++non_finite;
                continue;
            }
            const std::size_t tile =
                std::size_t(y / grid.tile_size_px) * grid.columns() + x / grid.tile_size_px;
            for (int c = 0; c < 3; ++c) sums[tile * CHANNELS + c] += rgb[c];
            sums[tile * CHANNELS + 3] += fourth(rgb);
        }
    }
    return sums;
}

MomentsOf moments_of(const Grid& grid, const TileReference& reference, std::size_t& non_finite) {
    const auto means = sum_tiles(grid, reference.mean, luminance_of_means, non_finite);
    const auto variances = sum_tiles(grid, reference.variance, luminance_of_variances, non_finite);
    return [=](const Block& block, int channel) {
        const double pixels = grid.pixel_count(block);
        Moments moments;
        moments.mean = grid.sum(means, block, channel) / pixels;
        moments.variance = grid.sum(variances, block, channel) / (pixels * pixels);
        return moments;
    };
}

MomentsOf moments_of(const Grid& grid, const std::vector<std::vector<double>>& seeds) {
    return [grid, &seeds](const Block& block, int channel) {
        const double count = double(seeds.size());
        std::vector<double> means(seeds.size());
        RunningMoments running;
        for (std::size_t i = 0; i < seeds.size(); ++i) {
            means[i] = grid.sum(seeds[i], block, channel) / grid.pixel_count(block);
            running.add(means[i]);
        }
        double cubes = 0;
        for (const double mean : means) cubes += std::pow(mean - running.mean(), 3);
        // The unbiased estimate of the third cumulant (k-statistic), then that of the mean.
        const double cumulant = seeds.size() < 3 ? 0.0 : cubes * count / ((count - 1) * (count - 2));
        return Moments{running.mean(), running.variance_of_mean(), cumulant / (count * count), count - 1};
    };
}

// The difference of two sides in a block, ready to be tested.
struct Difference {
    double value = 0;
    double standard_error = 0;
    double skewness = 0;
    double degrees_of_freedom = std::numeric_limits<double>::infinity();
    bool unseen = false;  // one side has met no sample here, the other has

    // Two-sided, after Hall's transformation where that lessens the doubt: the skewness is itself an
    // estimate, and one from few seeds would otherwise find significance in its own noise.
    double p_value() const {
        if (standard_error == 0.0) return value == 0.0 ? 1.0 : 0.0;
        const double t = value / standard_error;
        const double corrected =
            t + skewness * t * t / 3.0 + skewness * skewness * t * t * t / 27.0 + skewness / 6.0;
        return student_t_two_sided_p_value(std::min(std::abs(t), std::abs(corrected)), degrees_of_freedom);
    }
};

bool is_black(const Moments& moments) {
    return moments.mean == 0.0 && moments.variance == 0.0;
}

Difference subtract(const Moments& a, const Moments& b, double rounding) {
    const double rounding_error = rounding * std::max(std::abs(a.mean), std::abs(b.mean));
    Difference difference;
    difference.value = a.mean - b.mean;
    const double variance = a.variance + b.variance + rounding_error * rounding_error;
    difference.standard_error = std::sqrt(variance);
    difference.unseen = is_black(a) != is_black(b);
    if (variance == 0.0) return difference;
    difference.skewness = (a.third_cumulant - b.third_cumulant) / (variance * difference.standard_error);
    // Welch's statistic with the careful choice of the smaller side's freedom: Satterthwaite's formula takes
    // the variances for known and is too bold far out in the tail, where the corrected threshold lies.
    if (a.variance > 0.0) difference.degrees_of_freedom = a.degrees_of_freedom;
    if (b.variance > 0.0) {
        difference.degrees_of_freedom = std::min(difference.degrees_of_freedom, b.degrees_of_freedom);
    }
    return difference;
}

// Walks from single tiles to ever larger blocks; what is too skewed on one level is tested on the next.
class PooledTest {
  public:
    PooledTest(const Grid& grid, MomentsOf a, MomentsOf b, double rounding)
        : grid_(grid), a_(std::move(a)), b_(std::move(b)), rounding_(rounding) {}

    TileTest run(double significance) {
        result_.tiles = grid_.columns() * grid_.rows();
        for (int channel = 0; channel < CHANNELS; ++channel) test_channel(channel);
        result_.pooled_fraction = double(pooled_tiles_) / double(grid_.sum_count());
        result_.threshold = sidak_threshold(significance, std::max(result_.tests, 1));
        result_.passes = result_.min_p_value >= result_.threshold;
        for (const Power& power : powers_) {
            const double detectable_bias = power.detectable_bias(result_.threshold);
            if (detectable_bias <= result_.detectable_bias) continue;
            result_.detectable_bias = detectable_bias;
            result_.reference_share = power.reference_share;
        }
        return result_;
    }

  private:
    // What a test of luminance can find.
    struct Power {
        double relative_error;  // standard error of the difference over the reference's mean
        double degrees_of_freedom;
        double reference_share;  // of the variance

        double detectable_bias(double threshold) const {
            const double critical = student_t_quantile(1.0 - 0.5 * threshold, degrees_of_freedom);
            return relative_error * (critical + normal_quantile(0.9));
        }
    };

    struct Candidate {
        Block block;
        Moments a;
        Moments b;
        Difference difference;
    };

    void test_channel(int channel) {
        int columns = grid_.columns();
        int rows = grid_.rows();
        std::vector<bool> pending(std::size_t(columns) * rows, true);
        int size = 1;
        for (; columns > 1 || rows > 1; size *= 2) {
            pending = test_level(size, columns, rows, pending, channel);
            columns = (columns + 1) / 2;
            rows = (rows + 1) / 2;
        }
        if (pending[0]) record(evaluate({0, 0, size}, channel), channel);
    }

    // Tests the pending blocks of one level, four by four; returns which blocks of the next level are
    // pending.
    std::vector<bool> test_level(int size, int columns, int rows, const std::vector<bool>& pending,
                                 int channel) {
        const int parent_columns = (columns + 1) / 2;
        std::vector<bool> pooled(std::size_t(parent_columns) * ((rows + 1) / 2), false);
        for (std::size_t parent = 0; parent < pooled.size(); ++parent) {
            const int left = 2 * int(parent % std::size_t(parent_columns));
            const int top = 2 * int(parent / std::size_t(parent_columns));
            std::vector<Candidate> candidates;
            for (int y = top; y < std::min(top + 2, rows); ++y) {
                for (int x = left; x < std::min(left + 2, columns); ++x) {
                    if (pending[std::size_t(y) * columns + x])
                        candidates.push_back(evaluate({x, y, size}, channel));
                }
            }
            // All four together: to test just those that look well-behaved would select the ones that met no
            // rare event by luck.
            pooled[parent] = std::any_of(candidates.begin(), candidates.end(), is_too_skewed);
            if (pooled[parent] && size == 1) pooled_tiles_ += int(candidates.size());
            if (pooled[parent]) continue;
            for (const Candidate& candidate : candidates) record(candidate, channel);
        }
        return pooled;
    }

    Candidate evaluate(const Block& block, int channel) const {
        const Moments a = a_(block, channel);
        const Moments b = b_(block, channel);
        return {block, a, b, subtract(a, b, rounding_)};
    }

    static bool is_too_skewed(const Candidate& candidate) {
        return candidate.difference.unseen || std::abs(candidate.difference.skewness) > MAX_SKEWNESS;
    }

    void record(const Candidate& candidate, int channel) {
        ++result_.tests;
        if (channel == LUMINANCE_CHANNEL && candidate.b.mean > 0.0) {
            const Difference& difference = candidate.difference;
            const double variance = difference.standard_error * difference.standard_error;
            powers_.push_back({difference.standard_error / candidate.b.mean, difference.degrees_of_freedom,
                               variance > 0.0 ? candidate.b.variance / variance : 0.0});
        }
        const double p_value = candidate.difference.p_value();
        if (result_.tests > 1 && !(p_value < result_.min_p_value)) return;
        const int edge = candidate.block.size * grid_.tile_size_px;
        result_.min_p_value = p_value;
        result_.x = candidate.block.x * edge;
        result_.y = candidate.block.y * edge;
        result_.size_px = edge;
        result_.channel = channel;
        result_.mean = candidate.a.mean;
        result_.reference_mean = candidate.b.mean;
        result_.standard_error = candidate.difference.standard_error;
    }

    Grid grid_;
    MomentsOf a_;
    MomentsOf b_;
    double rounding_;
    TileTest result_;
    std::vector<Power> powers_;
    int pooled_tiles_ = 0;
};

TileTest finish(TileTest test, std::size_t non_finite) {
    test.non_finite = non_finite;
    test.passes = test.passes && non_finite == 0;
    return test;
}

}  // namespace

std::string describe(const TileTest& t) {
    return fmt::format(
        "smallest p {:.3g}, threshold {:.3g}, {:.0f} % of tests pooled; worst tile at ({}, {}), {} px, "
        "channel {}: {:.6g} against {:.6g}, standard error {:.3g}; finds a bias of {:.2g} %, "
        "{:.0f} % of its variance the reference's",
        t.min_p_value, t.threshold, 100.0 * t.pooled_fraction, t.x, t.y, t.size_px, t.channel, t.mean,
        t.reference_mean, t.standard_error, 100.0 * t.detectable_bias, 100.0 * t.reference_share);
}

TileSamples::TileSamples(int width_px, int height_px, int tile_size_px)
    : width_(width_px), height_(height_px), tile_size_px_(tile_size_px) {
    TARN_ASSERT(width_px > 0 && height_px > 0 && tile_size_px > 0, "{} x {} pixels in tiles of {}", width_px,
                height_px, tile_size_px);
}

void TileSamples::add(const Image& image) {
    const Grid grid{width_, height_, tile_size_px_};
    seeds_.push_back(sum_tiles(grid, image, luminance_of_means, non_finite_));
}

TileTest TileSamples::test(const TileReference& reference, double significance, double rounding) const {
    TARN_ASSERT(seed_count() >= 2, "{} seeds, at least 2 are needed", seed_count());
    const Grid grid{width_, height_, tile_size_px_};
    std::size_t non_finite = non_finite_;
    const MomentsOf reference_moments = moments_of(grid, reference, non_finite);
    PooledTest pooled(grid, moments_of(grid, seeds_), reference_moments, rounding);
    return finish(pooled.run(significance), non_finite);
}

TileTest TileSamples::test(const TileSamples& other, double significance, double rounding) const {
    TARN_ASSERT(seed_count() >= 2 && other.seed_count() >= 2, "{} and {} seeds, at least 2 are needed",
                seed_count(), other.seed_count());
    TARN_ASSERT(width_ == other.width_ && height_ == other.height_ && tile_size_px_ == other.tile_size_px_,
                "the samples differ in size: {} x {} and {} x {}", width_, height_, other.width_,
                other.height_);
    const Grid grid{width_, height_, tile_size_px_};
    PooledTest pooled(grid, moments_of(grid, seeds_), moments_of(grid, other.seeds_), rounding);
    return finish(pooled.run(significance), non_finite_ + other.non_finite_);
}

bool stands_out(const TileSamples& samples, const TileReference& reference, double significance) {
    constexpr int LOOK_EVERY = 8;
    if (samples.seed_count() == 0 || samples.seed_count() % LOOK_EVERY != 0) return false;
    return !samples.test(reference, significance / 100.0).passes;
}

TileTest test_tiles(const TileReference& samples, const TileReference& reference, int tile_size_px,
                    double significance, double rounding) {
    const Grid grid{reference.mean.width, reference.mean.height, tile_size_px};
    std::size_t non_finite = 0;
    const MomentsOf sample_moments = moments_of(grid, samples, non_finite);
    const MomentsOf reference_moments = moments_of(grid, reference, non_finite);
    return finish(PooledTest(grid, sample_moments, reference_moments, rounding).run(significance),
                  non_finite);
}

}  // namespace tarn
