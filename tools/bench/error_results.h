// What results.json says of the errors of one cell: estimates over seeds, and bias apart from variance.
#pragma once

#include <nlohmann/json.hpp>
#include <vector>

#include "bench/sequence.h"

namespace tarn {

// {mean, low, high, per_seed[]}: the mean over seeds and its 95 % interval.
nlohmann::ordered_json describe_values(const std::vector<double>& values);

// An estimate for each error, of one picture a seed. The interval of mean_ratio includes the noise of the
// reference.
nlohmann::ordered_json describe_errors(const std::vector<PictureErrors>& errors, const Truth& truth);

// The split of MSE, and of relMSE, over pictures of independent seeds; intervals include the noise of the
// reference.
nlohmann::ordered_json describe_bias(const std::vector<Image>& pictures, const Truth& truth);
nlohmann::ordered_json describe_relative_bias(const std::vector<Image>& pictures, const Truth& truth);

}  // namespace tarn
