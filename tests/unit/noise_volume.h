// Numbers over x, y and time, and how blue they are: power spectra by a plain Fourier sum, and what a seam
// shows.
#pragma once

#include <algorithm>
#include <cmath>
#include <complex>
#include <functional>
#include <numbers>
#include <vector>

namespace tarn::test {

// One number for each texel of width x height x slices.
class NoiseVolume {
  public:
    using Make = std::function<double(int x, int y, int t)>;

    NoiseVolume(int width, int height, int slices, const Make& make)
        : width_(width), height_(height), slices_(slices) {
        for (int t = 0; t < slices; ++t) {
            for (int y = 0; y < height; ++y) {
                for (int x = 0; x < width; ++x) values_.push_back(make(x, y, t));
            }
        }
        double sum = 0, squares = 0;
        for (const double v : values_) sum += v;
        mean_ = sum / double(values_.size());
        for (const double v : values_) squares += (v - mean_) * (v - mean_);
        variance_ = squares / double(values_.size());
    }

    int width() const { return width_; }
    int height() const { return height_; }
    int slices() const { return slices_; }
    double variance() const { return variance_; }

    // Wraps around; less the mean of all.
    double at(int x, int y, int t) const {
        const auto wrap = [](int i, int n) { return (i % n + n) % n; };
        const int row = wrap(t, slices_) * height_ + wrap(y, height_);
        return values_[std::size_t(row) * width_ + wrap(x, width_)] - mean_;
    }

  private:
    int width_, height_, slices_;
    std::vector<double> values_;
    double mean_ = 0, variance_ = 0;
};

using Complex = std::complex<double>;

// sum of values[i] exp(-2 pi i k / n), for k below n.
inline std::vector<Complex> fourier_sums(const std::vector<Complex>& values) {
    const int n = int(values.size());
    std::vector<Complex> turns, sums(values.size());
    for (int i = 0; i < n; ++i) turns.push_back(std::polar(1.0, -2.0 * std::numbers::pi * i / n));
    for (int k = 0; k < n; ++k) {
        for (int i = 0; i < n; ++i) sums[k] += values[i] * turns[k * i % n];
    }
    return sums;
}

// Frequency of the k-th of n sums, in cycles over all n.
inline int cycles(int k, int n) {
    return std::min(k, n - k);
}

// Fourier sums of one slice, in columns of rows.
inline std::vector<std::vector<Complex>> fourier_sums_of_slice(const NoiseVolume& volume, int t) {
    std::vector<std::vector<Complex>> columns(volume.width(), std::vector<Complex>(volume.height()));
    for (int y = 0; y < volume.height(); ++y) {
        std::vector<Complex> row;
        for (int x = 0; x < volume.width(); ++x) row.emplace_back(volume.at(x, y, t));
        row = fourier_sums(row);
        for (int x = 0; x < volume.width(); ++x) columns[x][y] = row[x];
    }
    for (std::vector<Complex>& column : columns) column = fourier_sums(column);
    return columns;
}

// Mean power of all slices at spatial frequencies from `low` to `high` cycles, the mean of a slice excluded.
// 1: white noise.
inline double slice_power(const NoiseVolume& volume, double low, double high) {
    double power = 0;
    int count = 0;
    for (int t = 0; t < volume.slices(); ++t) {
        const auto sums = fourier_sums_of_slice(volume, t);
        for (int x = 0; x < volume.width(); ++x) {
            for (int y = 0; y < volume.height(); ++y) {
                const double frequency = std::hypot(cycles(x, volume.width()), cycles(y, volume.height()));
                if (frequency == 0 || frequency < low || frequency > high) continue;
                power += std::norm(sums[x][y]);
                ++count;
            }
        }
    }
    return power / (count * volume.variance() * volume.width() * volume.height());
}

// Mean power of all pixels' sequences at `low` to `high` cycles in all slices. 1: white noise.
inline double time_power(const NoiseVolume& volume, int low, int high) {
    double power = 0;
    int count = 0;
    for (int y = 0; y < volume.height(); ++y) {
        for (int x = 0; x < volume.width(); ++x) {
            std::vector<Complex> sequence;
            for (int t = 0; t < volume.slices(); ++t) sequence.emplace_back(volume.at(x, y, t));
            sequence = fourier_sums(sequence);
            for (int k = low; k <= high; ++k, ++count) power += std::norm(sequence[k]);
        }
    }
    return power / (count * volume.variance() * volume.slices());
}

// Mean of (2 radius + 1)^2 pixels, with wrap-around.
inline double blur(const NoiseVolume& volume, int x, int y, int t, int radius) {
    double sum = 0;
    for (int j = -radius; j <= radius; ++j) {
        for (int i = -radius; i <= radius; ++i) sum += volume.at(x + i, y + j, t);
    }
    return sum / ((2 * radius + 1) * (2 * radius + 1));
}

// Mean square of blurs that reach over the slices' left border, over that of all others. 1: there is no seam.
inline double seam_ratio(const NoiseVolume& volume) {
    constexpr int RADIUS = 2;
    double squares[2] = {0, 0};
    int counts[2] = {0, 0};
    for (int t = 0; t < volume.slices(); ++t) {
        for (int y = RADIUS; y < volume.height() - RADIUS; ++y) {
            for (int x = 0; x < volume.width(); ++x) {
                const bool crosses = x < RADIUS || x >= volume.width() - RADIUS;
                const double mean = blur(volume, x, y, t, RADIUS);
                squares[crosses] += mean * mean;
                ++counts[crosses];
            }
        }
    }
    return squares[1] / counts[1] * counts[0] / squares[0];
}

}  // namespace tarn::test
