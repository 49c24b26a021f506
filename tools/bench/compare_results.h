// Two results.json against each other: what got faster, slower, better or worse beyond the noise.
//
// Errors: seeds that both runs share have the same random numbers, so cells of equal settings and frames are
// tested seed by seed (paired); others as independent samples. What a budget paid for is compared only where
// both runs could pay for the same.
//
// Times: a machine is never as fast as it was. So a pass is held against the other passes of its method,
// which ran beside it: each seed's slowness is taken off, then the factor that most of them share, and what
// stands out from how all passes scatter is told. The frame of a method is held against those of all methods
// in the same way. What slows most passes of all methods at once looks like another machine: the summary
// tells that factor.
//
// All tests of a comparison together raise a false alarm in one of a hundred comparisons (Sidak).
#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace tarn {

// Changes below these are not told, however certain: shares of the value before.
inline constexpr double SMALLEST_TIME_CHANGE = 0.05;
inline constexpr double SMALLEST_ERROR_CHANGE = 0.001;

// Returns {"old", "machine_factor", "machine_scatter", "summary", "findings": [{"what", "before", "after",
// "ratio", "verdict", "p_value"}]}, which the page shows as "comparison". `old_name` stands for the old run.
// What only one of the two runs has is told in the summary and not compared.
nlohmann::ordered_json compare_results(const nlohmann::ordered_json& before,
                                       const nlohmann::ordered_json& after, const std::string& old_name);

// Prints the same.
void print_comparison(const nlohmann::ordered_json& comparison);

}  // namespace tarn
