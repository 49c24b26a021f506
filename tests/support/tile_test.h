// Is a random image estimator unbiased? A test per tile of its mean against a reference's, with all errors
// counted.
//
// Pixels of one rendered image are correlated (resampling shares samples between neighbours), so the error of
// a tile's mean cannot come from the variances of its pixels. It comes from the spread of the tile's mean
// over images of independent seeds, which needs no model of the correlation. The reference's pixels ARE
// independent (a path tracer), so there the per-pixel variances of the mean add up.
//
// Each tile and each of R, G, B and luminance is one test, by Welch's t, with these corrections:
// * Degrees of freedom are those of the side with fewer seeds, less one: far out in the tail, where the
//   threshold of many tests lies, Satterthwaite's larger number finds too much.
// * Rendering noise is skewed (rare bright samples). Then mean and spread are correlated and t is too often
//   too low. Hall's cubic transformation (P. Hall, "On the removal of skewness by transformation", JRSS B 54,
//   1992) removes the first-order effect; it is applied where it makes the test more careful. Where the mean
//   of a tile is still too skewed for it (fewer than about 16 rare events), or one side has met no light
//   there at all, the tile is pooled with its neighbours (2 x 2, 4 x 4, ...) and tested as one.
// * All tests together fail by chance with probability `significance` (Sidak).
//
// What it cannot see: an event so rare that no seed met it, beside others that look well-behaved. Then the
// estimate is too low and seems precise, and the test fails though the estimator is unbiased; more seeds are
// the remedy.
#pragma once

#include <algorithm>
#include <cstddef>
#include <string>
#include <vector>

#include "core/image.h"

namespace tarn {

struct TileTest {
    int tiles = 0;           // tiles of the finest level
    int tests = 0;           // tiles x channels that were tested, after pooling
    double min_p_value = 1;  // of the worst test
    double threshold = 0;    // Sidak-corrected: min_p_value below it disproves equality
    bool passes = false;     // min_p_value >= threshold and every pixel was finite
    int x = 0;               // the worst tile's left column, in pixels
    int y = 0;               // the worst tile's top row, in pixels
    int size_px =
        0;  // the worst tile's edge length, in pixels: larger than asked for where tiles were pooled
    int channel = 0;  // the worst test's channel: 0 R, 1 G, 2 B, 3 luminance (Rec. 709)
    double mean = 0;  // of the samples in the worst test
    double reference_mean = 0;
    double standard_error = 0;   // of the difference of the two
    double pooled_fraction = 0;  // share of tiles x channels that were pooled
    std::size_t non_finite = 0;  // pixels that were left out of both sides
    // Power: the relative bias in luminance that the weakest of the tests would find nine times in ten.
    double detectable_bias = 0;
    // Share of the variance in that test that is the reference's: where it is small, more samples of the
    // reference find nothing more.
    double reference_share = 0;
};

// "smallest p 0.03, threshold 0.0001, 17 % of tests pooled; worst tile at (16, 32), 16 px, channel 3: 0.24
// against 0.25, standard error 0.004; finds a bias of 2.1 %, 10 % of its variance the reference's".
std::string describe(const TileTest& test);

// The mean of a reference image and the variance of that mean, per pixel and channel (3 channels each). The
// variance must be that of the MEAN (the sample variance divided by the sample count).
struct TileReference {
    Image mean;
    Image variance;
};

// How many of the frames up to `last`, counted from 0, a test of a still camera averages for each seed: all
// have the same mean, and the noise of each adds news. Eight of them have 0.63 of one's variance. Not the
// early ones, whose history is short.
constexpr int averaged_frames(int last) {
    return std::clamp((last + 1) / 2, 1, 8);
}

// Collects images of independent seeds as tile means and tests them against a reference.
class TileSamples {
  public:
    // Tiles of `tile_size_px` squared; those at the right and bottom edges are smaller.
    TileSamples(int width_px, int height_px, int tile_size_px = 16);

    // Adds the image of one more seed: 3 channels of linear radiance, of the size given at construction.
    // Non-finite pixels are left out and counted; any of them makes the test fail.
    void add(const Image& image);

    int seed_count() const { return int(seeds_.size()); }

    // Tests the samples' means against `reference`. Needs at least 2 seeds, better 16 and more.
    // `rounding` is the relative error that float arithmetic is allowed on both sides.
    TileTest test(const TileReference& reference, double significance = 0.01, double rounding = 1e-5) const;

    // The same against samples of another estimator, which must have the same sizes.
    TileTest test(const TileSamples& other, double significance = 0.01, double rounding = 1e-5) const;

  private:
    int width_;
    int height_;
    int tile_size_px_;
    std::vector<std::vector<double>> seeds_;  // [seed][tile][channel]: sums over the tile's finite pixels
    std::size_t non_finite_ = 0;
};

// Whether a planted mistake stands out so far that more seeds are not worth their time. Looks after every
// eighth seed, and so at a hundredth of `significance`: several looks together find no more by chance than
// the one at the end.
bool stands_out(const TileSamples& samples, const TileReference& reference, double significance = 0.01);

// z-test per tile of two images whose pixels are all independent, each with its mean and the variance of that
// mean.
TileTest test_tiles(const TileReference& samples, const TileReference& reference, int tile_size_px = 16,
                    double significance = 0.01, double rounding = 1e-5);

}  // namespace tarn
