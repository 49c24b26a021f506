#include "bench/error_results.h"

#include <cmath>

#include "metrics/bias_variance.h"
#include "metrics/seed_statistics.h"

namespace tarn {
namespace {

using Json = nlohmann::ordered_json;

// Half of the 95 % interval that the reference's own noise adds to bias squared, as if it were normal: the
// square of a pixel's error varies by twice its variance squared.
double find_reference_reach(const Image& variance) {
    double sum = 0.0, pixels = 0.0;
    for (std::size_t i = 0; i < variance.pixel_count(); ++i) {
        const double pixel =
            (double(variance.values[3 * i]) + variance.values[3 * i + 1] + variance.values[3 * i + 2]) / 3.0;
        if (!std::isfinite(pixel)) continue;
        sum += 2.0 * pixel * pixel;
        pixels += 1.0;
    }
    return pixels > 0.0 ? 1.96 * std::sqrt(sum) / pixels : 0.0;
}

// The split of `pictures` against a reference whose mean has `variance`, errors times `scale`.
Json describe_split(const Image& reference, const Image& variance, const std::vector<Image>& pictures,
                    double scale) {
    const BiasVariance split = split_bias_variance(reference, pictures, mean_finite_value(variance));
    const double reference_reach = find_reference_reach(variance);
    const double reach = std::hypot(split.bias_squared_high - split.bias_squared, reference_reach);
    return {{"bias_squared", scale * split.bias_squared},
            {"low", scale * (split.bias_squared - reach)},
            {"high", scale * (split.bias_squared + reach)},
            {"variance", scale * split.variance},
            {"mse_of_mean", scale * split.mse_of_mean},
            {"neighbour_autocorrelation", split.neighbour_autocorrelation}};
}

// Half of the 95 % interval that the reference's own noise adds to the energy, as a share of it. The channels
// of a pixel are taken to err together, which widens it at most.
double find_energy_reach(const Truth& truth) {
    double variance = 0.0, sum = 0.0;
    for (std::size_t i = 0; i < truth.variance.pixel_count(); ++i) {
        double deviation = 0.0, value = 0.0;
        for (std::size_t c = 3 * i; c < 3 * i + 3; ++c) {
            deviation += std::sqrt(double(truth.variance.values[c]));
            value += double(truth.radiance.values[c]);
        }
        if (!std::isfinite(deviation + value)) continue;
        variance += deviation * deviation;
        sum += value;
    }
    return sum > 0.0 ? 1.96 * std::sqrt(variance) / sum : 0.0;
}

}  // namespace

Json describe_values(const std::vector<double>& values) {
    const Estimate estimate = estimate_mean(values);
    return {{"mean", estimate.mean}, {"low", estimate.low}, {"high", estimate.high}, {"per_seed", values}};
}

Json describe_errors(const std::vector<PictureErrors>& errors, const Truth& truth) {
    Json json;
    const auto add = [&](const char* name, auto get) {
        std::vector<double> values;
        for (const PictureErrors& e : errors) values.push_back(get(e));
        json[name] = describe_values(values);
    };
    add("mse", [](const PictureErrors& e) { return e.linear.mse; });
    add("rel_mse", [](const PictureErrors& e) { return e.linear.rel_mse; });
    add("rel_mse_trimmed", [](const PictureErrors& e) { return e.linear.rel_mse_trimmed; });
    add("rmspe", [](const PictureErrors& e) { return e.linear.rmspe; });
    add("mape", [](const PictureErrors& e) { return e.linear.mape; });
    add("mean_ratio", [](const PictureErrors& e) { return e.linear.mean_ratio; });
    add("flip_ldr", [](const PictureErrors& e) { return double(e.flip_ldr); });

    Json& energy = json["mean_ratio"];
    const double mean = energy["mean"];
    const double reach = std::hypot(energy["high"].get<double>() - mean, mean * find_energy_reach(truth));
    energy["low"] = mean - reach;
    energy["high"] = mean + reach;
    return json;
}

Json describe_bias(const std::vector<Image>& pictures, const Truth& truth) {
    return describe_split(truth.radiance, truth.variance, pictures,
                          std::exp2(2.0 * double(truth.exposure_ev)));
}

// The split of relMSE: each value over the root of relMSE's divisor.
Json describe_relative_bias(const std::vector<Image>& pictures, const Truth& truth) {
    const double scale = std::exp2(double(truth.exposure_ev));
    std::vector<float> weights;
    for (const float value : truth.radiance.values) {
        weights.push_back(float(scale / std::sqrt(scale * scale * double(value) * value + REL_MSE_EPSILON)));
    }
    const auto weigh = [&](Image image) {
        for (std::size_t i = 0; i < weights.size(); ++i) image.values[i] *= weights[i];
        return image;
    };
    std::vector<Image> weighed;
    for (const Image& picture : pictures) weighed.push_back(weigh(picture));
    return describe_split(weigh(truth.radiance), weigh(weigh(truth.variance)), weighed, 1.0);
}

}  // namespace tarn
