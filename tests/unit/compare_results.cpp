// Two runs against each other: planted changes are told, in the right row; an unchanged run tells nothing.
#include "bench/compare_results.h"

#include <gtest/gtest.h>

#include "support/toy_bench.h"

namespace tarn::test {
namespace {

using Json = nlohmann::ordered_json;

// A run of two methods, of which `fault` hits the second; `time_seed` and `slowness` make it another day.
Json run_with(const ToyFault& fault, unsigned time_seed, double slowness = 1.0,
              std::uint32_t first_seed = 0) {
    const TemporaryFolder folder;
    BenchPlan plan = toy_plan("uniform,ris");
    plan.budgets_ms = {};
    plan.first_seed = first_seed;
    ToySource source({ToyFault(), fault}, 0.5, slowness, time_seed);
    Json results = run_toy_bench(plan, source, folder.path());
    results["settings"] = {{"first_seed", first_seed}};
    return results;
}

std::vector<std::string> tell(const Json& before, const Json& after) {
    std::vector<std::string> told;
    const Json comparison = compare_results(before, after, "old");
    for (const Json& finding : comparison["findings"]) {
        told.push_back(finding["verdict"].get<std::string>() + " " + finding["what"].get<std::string>());
    }
    return told;
}

bool has(const std::vector<std::string>& told, const std::string& text) {
    return std::any_of(told.begin(), told.end(),
                       [&](const std::string& line) { return line.find(text) != std::string::npos; });
}

// Every line is of the second method.
bool only_second(const std::vector<std::string>& told) {
    return std::all_of(told.begin(), told.end(),
                       [](const std::string& line) { return line.find(", ris,") != std::string::npos; });
}

class CompareResults : public testing::Test {
  protected:
    static void SetUpTestSuite() { steady_ = run_with({}, 1); }
    static inline Json steady_;
};

TEST_F(CompareResults, ARunAgainstItselfTellsNothing) {
    EXPECT_TRUE(tell(steady_, steady_).empty());
}

TEST_F(CompareResults, AnotherDayOnASlowerMachineTellsNothing) {
    const Json slower = run_with({}, 2, 1.7);
    EXPECT_TRUE(tell(steady_, slower).empty());
    EXPECT_NEAR(compare_results(steady_, slower, "old")["machine_factor"].get<double>(), 1.7, 0.05);
}

TEST_F(CompareResults, OtherSeedsTellNothing) {
    EXPECT_TRUE(tell(steady_, run_with({}, 3, 1.0, 100)).empty());
}

TEST_F(CompareResults, TwoPercentOfBrightnessAreToldAsEnergy) {
    ToyFault fault;
    fault.brightness = 1.02;
    const auto told = tell(steady_, run_with(fault, 4));
    EXPECT_TRUE(has(told, "worse toy 24x16, ris, mean of 16: mean_ratio"));
    EXPECT_TRUE(only_second(told));
    EXPECT_FALSE(has(told, "slower"));
}

TEST_F(CompareResults, APassSlowedByAFifthIsToldByItsName) {
    ToyFault fault;
    fault.shading_slowdown = 1.2;
    const auto told = tell(steady_, run_with(fault, 5, 1.3));
    EXPECT_TRUE(has(told, "slower toy 24x16, ris, mean of 16: pass toy/shade"));
    EXPECT_TRUE(only_second(told));
    EXPECT_FALSE(has(told, "toy/resolve"));
    EXPECT_FALSE(has(told, "worse"));
}

TEST_F(CompareResults, ABiasIsToldAsError) {
    ToyFault fault;
    fault.bias = 0.2;
    const auto told = tell(steady_, run_with(fault, 6));
    EXPECT_TRUE(has(told, "worse toy 24x16, ris, mean of 16: mse"));
    EXPECT_TRUE(only_second(told));
}

TEST_F(CompareResults, ADroppedFrameIsToldAsACount) {
    ToyFault fault;
    fault.dropped = {5};
    const auto told = tell(steady_, run_with(fault, 7));
    EXPECT_TRUE(has(told, "worse toy 24x16, ris, mean of 16: repeated_frames"));
    EXPECT_TRUE(only_second(told));
}

TEST_F(CompareResults, WhatGotBetterIsToldAsBetter) {
    ToyFault fault;
    fault.shading_slowdown = 1.2;
    fault.bias = 0.2;
    const auto told = tell(run_with(fault, 8), steady_);
    EXPECT_TRUE(has(told, "better toy 24x16, ris, mean of 16: mse"));
    EXPECT_TRUE(has(told, "faster toy 24x16, ris, mean of 16: pass toy/shade"));
    // FLIP of one noisy frame may prefer the brighter picture: less of its noise is clamped at black.
    EXPECT_FALSE(has(told, "worse toy 24x16, ris, mean of 16"));
    EXPECT_FALSE(has(told, "slower"));
}

// False alarms of twenty pairs of days: the tests promise one in a hundred comparisons.
TEST_F(CompareResults, FalseAlarmsAreRare) {
    int alarms = 0;
    Json before = steady_;
    for (unsigned day = 0; day < 20; ++day) {
        Json after = run_with({}, 100 + day, 1.0, 1000 + 10 * day);
        alarms += !tell(before, after).empty();
        before = std::move(after);
    }
    EXPECT_LE(alarms, 2);
}

}  // namespace
}  // namespace tarn::test
