// Bias squared is the mean product of the errors of two different seeds; the jackknife leaves out one seed at
// a time.
#include "metrics/bias_variance.h"

#include <cmath>
#include <vector>

#include "core/error.h"
#include "core/statistics.h"
#include "metrics/image_error.h"

namespace tarn {
namespace {

std::vector<bool> finite_pixels(const Image& reference, std::span<const Image> images,
                                std::size_t& non_finite) {
    std::vector<bool> finite(reference.pixel_count(), true);
    for (const Image& image : images) {
        for (std::size_t i = 0; i < finite.size(); ++i)
            finite[i] = finite[i] && is_pixel_finite(reference, image, i);
    }
    for (const bool pixel : finite) non_finite += pixel ? 0 : 1;
    return finite;
}

// Sums over seeds of the error at each value; 0 where the pixel does not count.
std::vector<double> sum_errors(const Image& reference, std::span<const Image> images,
                               const std::vector<bool>& finite) {
    std::vector<double> sums(reference.values.size(), 0.0);
    for (const Image& image : images) {
        for (std::size_t i = 0; i < sums.size(); ++i) {
            if (finite[i / 3]) sums[i] += double(image.values[i]) - reference.values[i];
        }
    }
    return sums;
}

// The inner products that all estimates are made of, averaged over values.
struct Products {
    double sum_with_sum = 0;             // |sum of errors|^2
    std::vector<double> seed_with_seed;  // |error of seed i|^2
    std::vector<double> seed_with_sum;   // error of seed i times the sum of errors
};

Products multiply(const Image& reference, std::span<const Image> images, const std::vector<bool>& finite,
                  const std::vector<double>& sums, double value_count) {
    Products products;
    for (const double sum : sums) products.sum_with_sum += sum * sum / value_count;
    for (const Image& image : images) {
        double own = 0;
        double mixed = 0;
        for (std::size_t i = 0; i < sums.size(); ++i) {
            if (!finite[i / 3]) continue;
            const double error = double(image.values[i]) - reference.values[i];
            own += error * error;
            mixed += error * sums[i];
        }
        products.seed_with_seed.push_back(own / value_count);
        products.seed_with_sum.push_back(mixed / value_count);
    }
    return products;
}

// The mean product of the errors of two different of `count` seeds.
double mean_cross_product(double sum_with_sum, double squares, double count) {
    return (sum_with_sum - squares) / (count * (count - 1.0));
}

void estimate_bias(const Products& products, double reference_variance, BiasVariance& split) {
    const double count = split.images;
    double squares = 0;
    for (const double square : products.seed_with_seed) squares += square;
    split.mse_of_mean = products.sum_with_sum / (count * count);
    const double cross = mean_cross_product(products.sum_with_sum, squares, count);
    split.variance = squares / count - cross;
    split.bias_squared = cross - reference_variance;

    RunningMoments left_out;
    for (std::size_t i = 0; i < products.seed_with_seed.size(); ++i) {
        const double square = products.seed_with_seed[i];
        const double rest = products.sum_with_sum - 2.0 * products.seed_with_sum[i] + square;
        left_out.add(mean_cross_product(rest, squares - square, count - 1.0));
    }
    const double standard_error = (count - 1.0) * std::sqrt(left_out.variance_of_mean());
    const double reach = student_t_quantile(0.975, count - 1.0) * standard_error;
    split.bias_squared_low = split.bias_squared - reach;
    split.bias_squared_high = split.bias_squared + reach;
}

void estimate_correlation(const Image& reference, std::span<const Image> images,
                          const std::vector<bool>& finite, const std::vector<double>& sums,
                          BiasVariance& split) {
    const double count = split.images;
    double products = 0;
    double pairs = 0;
    const auto deviation = [&](const Image& image, std::size_t i) {
        return double(image.values[i]) - reference.values[i] - sums[i] / count;
    };
    const auto add_pair = [&](std::size_t pixel, std::size_t neighbour) {
        if (!finite[pixel] || !finite[neighbour]) return;
        for (const Image& image : images) {
            for (std::size_t c = 0; c < 3; ++c) {
                products += deviation(image, 3 * pixel + c) * deviation(image, 3 * neighbour + c);
            }
        }
        pairs += 3.0;
    };
    const auto width = std::size_t(reference.width);
    for (std::size_t i = 0; i < reference.pixel_count(); ++i) {
        if ((i + 1) % width != 0) add_pair(i, i + 1);
        if (i + width < reference.pixel_count()) add_pair(i, i + width);
    }
    if (pairs == 0.0) return;
    // The mean was taken from the same seeds: count - 1, as in a variance.
    split.neighbour_autocovariance = products / (pairs * (count - 1.0));
    if (split.variance > 0.0)
        split.neighbour_autocorrelation = split.neighbour_autocovariance / split.variance;
}

}  // namespace

BiasVariance split_bias_variance(const Image& reference, std::span<const Image> images,
                                 double reference_variance) {
    if (images.size() < 3)
        throw Error("{} images cannot be split into bias and variance, 3 are needed", images.size());
    for (const Image& image : images) check_comparable(reference, image);
    BiasVariance split;
    split.images = int(images.size());
    const std::vector<bool> finite = finite_pixels(reference, images, split.non_finite);
    const double value_count = 3.0 * double(reference.pixel_count() - split.non_finite);
    if (value_count == 0.0)
        throw Error("none of the {} pixels is finite in all pictures", reference.pixel_count());
    const std::vector<double> sums = sum_errors(reference, images, finite);
    estimate_bias(multiply(reference, images, finite, sums, value_count), reference_variance, split);
    estimate_correlation(reference, images, finite, sums, split);
    return split;
}

}  // namespace tarn
