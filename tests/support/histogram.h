// Counts in bins, tested against what a density promises.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "support/goodness_of_fit.h"

namespace tarn::test {

// Chance with which one sound statistical check is allowed to fail. Seeds are fixed, so a check that passes
// once always passes; the threshold was chosen before looking.
inline constexpr double SIGNIFICANCE = 1e-4;

// A grid of bins over the unit square.
class Histogram {
  public:
    Histogram(int columns, int rows) : columns_(columns), rows_(rows), counts_(std::size_t(columns) * rows) {}

    // (x, y) in [0, 1]^2; what lies outside by rounding goes to the nearest bin.
    void add(double x, double y = 0.5) {
        ++counts_[std::size_t(bin(y, rows_)) * columns_ + bin(x, columns_)];
    }

    const std::vector<double>& counts() const { return counts_; }
    int columns() const { return columns_; }
    int rows() const { return rows_; }

    // p value of "all bins are equally likely".
    double uniform_p_value() const {
        double total = 0;
        for (const double count : counts_) total += count;
        const std::vector<double> expected(counts_.size(), total / double(counts_.size()));
        return chi_square_test(counts_, expected).p_value;
    }

  private:
    static int bin(double x, int count) { return std::clamp(int(std::floor(x * count)), 0, count - 1); }

    int columns_;
    int rows_;
    std::vector<double> counts_;
};

}  // namespace tarn::test
