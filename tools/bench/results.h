// From measured sequences to results.json, whose schema tools/bench/README.md describes.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "bench/bench_run.h"

namespace tarn {

inline constexpr const char* RESULTS_FORMAT = "tarn-results";
inline constexpr int RESULTS_VERSION = 1;

// Describes what `work` holds of every cell and seed, and writes the pictures that it names into
// `picture_folder` (which must exist), their names beginning with `picture_prefix`. Throws Error where a
// sequence is missing or a picture cannot be written.
nlohmann::ordered_json describe_methods(const BenchPlan& plan, const std::vector<Cell>& cells,
                                        const Truth& truth, const WorkFolder& work,
                                        const std::filesystem::path& picture_folder,
                                        const std::string& picture_prefix);

// Milliseconds that each method needs for the errors of the first method's curve; from "curve" of methods
// that describe_methods() made.
nlohmann::ordered_json describe_equal_error(const nlohmann::ordered_json& methods);

// What is known of the truth, and its pictures.
nlohmann::ordered_json describe_truth(const Truth& truth, const std::filesystem::path& picture_folder,
                                      const std::string& picture_prefix);

// Every setting by name, choices as words.
nlohmann::ordered_json describe_settings(const RenderSettings& settings);

}  // namespace tarn
