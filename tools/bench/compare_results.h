// Two results.json against each other: what got faster, slower, better or worse beyond the noise.
//
// Errors: seeds that both runs share have the same random numbers, so cells of equal settings and frames are
// tested seed by seed (paired); others as independent samples. What a budget paid for is compared only where
// both runs could pay for the same.
//
// Times: the speed of a machine varies between runs. So a pass is compared with the other passes of its
// method, which ran beside it: each seed's slowness is taken off, then the factor that most passes share.
// What stands out from the scatter of all passes is reported. The frame of a method is compared with those of
// all methods in the same way. What slows most passes of all methods at once looks like another machine: the
// summary states that factor.
//
// All tests of a comparison together raise a false alarm in one of a hundred comparisons (Sidak).
#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace tarn {

// Changes below these are not reported, however certain: shares of the value before.
inline constexpr double SMALLEST_TIME_CHANGE = 0.05;
inline constexpr double SMALLEST_ERROR_CHANGE = 0.001;

// Returns {"old", "machine_factor", "machine_scatter", "summary", "findings": [{"what", "before", "after",
// "ratio", "verdict", "p_value"}]}, which the page shows as "comparison". `old_name` stands for the old run.
// What only one of the two runs has is named in the summary and not compared.
nlohmann::ordered_json compare_results(const nlohmann::ordered_json& before,
                                       const nlohmann::ordered_json& after, const std::string& old_name);

// Prints the same.
void print_comparison(const nlohmann::ordered_json& comparison);

}  // namespace tarn
