// Equal time: how much larger the error of each method is than the best one's, all given the same
// milliseconds.
#pragma once

#include <nlohmann/json.hpp>

namespace tarn {

// For each budget: the method of the least relMSE, and the ratio of each method's to it, from the budget
// cells that describe_methods() made. Only what is alike is compared: cells within a quarter of the budget,
// drawn at the picture's own resolution. The others have a reason instead of a ratio; `best` is null where
// all have. Seeds are paired, as all methods ran with the same ones; intervals are 95 %, by the jackknife
// over seeds on the logarithm of the ratio.
nlohmann::ordered_json describe_equal_time(const nlohmann::ordered_json& methods);

}  // namespace tarn
