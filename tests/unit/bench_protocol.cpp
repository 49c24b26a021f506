// The benchmark's protocol on a source whose noise, bias and time are known.
#include <gtest/gtest.h>

#include <cmath>

#include "bench/curve_results.h"
#include "support/toy_bench.h"

namespace tarn::test {
namespace {

using Json = nlohmann::ordered_json;

const Json& cell_of(const Json& results, std::size_t method, const std::string& kind) {
    for (const Json& cell : results["scenes"][0]["methods"][method]["cells"]) {
        if (cell["kind"] == kind) return cell;
    }
    throw std::runtime_error("no cell " + kind);
}

bool holds(const Json& estimate, double truth) {
    return estimate["low"].get<double>() <= truth && truth <= estimate["high"].get<double>();
}

TEST(BenchProtocol, AnUnbiasedMethodsErrorIsItsVarianceAndFallsWithTime) {
    const TemporaryFolder folder;
    ToySource source({{}}, 0.5);
    const Json results = run_toy_bench(toy_plan("uniform"), source, folder.path());
    const Json& method = results["scenes"][0]["methods"][0];
    EXPECT_NEAR(cell_of(results, 0, "first")["errors"]["mse"]["mean"].get<double>(), 0.25, 0.02);
    EXPECT_NEAR(cell_of(results, 0, "mean")["errors"]["mse"]["mean"].get<double>(), 0.25 / 16, 0.002);
    EXPECT_NEAR(method["slope"]["mean"].get<double>(), -1.0, 0.1);
    const Json& bias = cell_of(results, 0, "mean")["bias"];
    EXPECT_LE(bias["low"].get<double>(), 0.0);
    EXPECT_GE(bias["high"].get<double>(), 0.0);
    EXPECT_NEAR(bias["neighbour_autocorrelation"].get<double>(), 0.0, 0.03);
    EXPECT_EQ(cell_of(results, 0, "mean")["counts"]["rays_per_pixel"], 1.0);
}

TEST(BenchProtocol, AKnownBiasStandsApartFromNoiseAndFlattensTheCurve) {
    const TemporaryFolder folder;
    ToyFault biased;
    biased.bias = 0.2;
    ToySource source({{}, biased}, 0.5);
    const Json results = run_toy_bench(toy_plan("uniform,ris"), source, folder.path());
    const Json& bias = cell_of(results, 1, "mean")["bias"];
    EXPECT_GT(bias["low"].get<double>(), 0.0);
    EXPECT_TRUE(bias["low"].get<double>() <= 0.04 && 0.04 <= bias["high"].get<double>()) << bias.dump();
    const Json& relative = cell_of(results, 1, "mean")["relative_bias"];
    double expected = 0.0;
    const Image truth = ToySource::make_reference().radiance;
    for (const float value : truth.values)
        expected += 0.04 / (double(value) * value + 0.01) / double(truth.values.size());
    EXPECT_TRUE(holds(relative, expected)) << relative.dump() << " against " << expected;
    EXPECT_GT(results["scenes"][0]["methods"][1]["slope"]["low"].get<double>(), -0.9);
    EXPECT_LE(cell_of(results, 0, "mean")["bias"]["low"].get<double>(), 0.0);
}

TEST(BenchProtocol, TwoPercentOfBrightnessLeaveTheIntervalOfTheMeanRatio) {
    const TemporaryFolder folder;
    ToyFault brighter;
    brighter.brightness = 1.02;
    ToySource source({{}, brighter}, 0.2);
    const Json results = run_toy_bench(toy_plan("uniform,ris"), source, folder.path());
    const Json& ratio = cell_of(results, 1, "mean")["errors"]["mean_ratio"];
    EXPECT_GT(ratio["low"].get<double>(), 1.0);
    EXPECT_TRUE(holds(ratio, 1.02)) << ratio.dump();
    EXPECT_TRUE(holds(cell_of(results, 0, "mean")["errors"]["mean_ratio"], 1.0));
}

TEST(BenchProtocol, ADroppedFrameIsCounted) {
    const TemporaryFolder folder;
    ToyFault lossy;
    lossy.dropped = {5};
    ToySource source({{}, lossy});
    const Json results = run_toy_bench(toy_plan("uniform,ris"), source, folder.path());
    EXPECT_EQ(cell_of(results, 0, "mean")["counts"]["repeated_frames"], 0);
    EXPECT_EQ(cell_of(results, 1, "mean")["counts"]["repeated_frames"], 8);  // one a seed
}

TEST(BenchProtocol, BudgetsAreFilledByTheDialElseByFrames) {
    const TemporaryFolder folder;
    ToySource source(std::vector<ToyFault>(2));
    const Json results = run_toy_bench(toy_plan("uniform:samples=1,ris"), source, folder.path());
    for (std::size_t method : {0u, 1u}) {
        for (const Json& cell : results["scenes"][0]["methods"][method]["cells"]) {
            if (cell["kind"] != "budget") continue;
            const double budget_ms = cell["budget_ms"];
            // A frame of "uniform" takes 6.6 ms: two of them come nearest to 12 ms.
            const double tolerance = method == 0 ? 3.3 : 0.1 * budget_ms;
            EXPECT_NEAR(cell["ms"]["median"].get<double>(), budget_ms, tolerance);
            EXPECT_EQ(method == 1, cell["frames"] == 1);
        }
    }
}

// 5.05 ms with one candidate: three quarters of the size take 2.84 ms, a half 1.26 ms.
TEST(BenchProtocol, ABudgetTooSmallForOneFrameBuysFewerPixels) {
    const TemporaryFolder folder;
    ToySource source(std::vector<ToyFault>(2));
    BenchPlan plan = toy_plan("uniform:samples=1,ris");
    plan.budgets_ms = {0.1, 2.0, 2.8};
    const Json results = run_toy_bench(plan, source, folder.path());
    const auto resolution_of = [&](std::size_t method, std::size_t budget) {
        return results["scenes"][0]["methods"][method]["cells"][2 + budget]["resolution"].get<double>();
    };
    EXPECT_EQ(resolution_of(1, 0), 0.25);  // the least there is
    EXPECT_EQ(resolution_of(1, 1), 0.5);
    EXPECT_EQ(resolution_of(1, 2), 0.75);
    EXPECT_EQ(resolution_of(0, 1), 0.5);  // 6.6 ms a frame of 32 candidates, without a dial
    EXPECT_EQ(cell_of(results, 1, "mean")["resolution"], 1.0);
}

TEST(BenchProtocol, EqualTimeNamesTheBestAndHowFarTheOthersAreFromIt) {
    const TemporaryFolder folder;
    ToySource source(std::vector<ToyFault>(2));
    // The time of the one goes into frames, whose mean is better; that of the other into a dial that helps
    // nothing.
    const Json results = run_toy_bench(toy_plan("uniform:samples=1,ris"), source, folder.path());
    const Json& budgets = results["scenes"][0]["equal_time"];
    ASSERT_EQ(budgets.size(), 2u);
    const Json& budget = budgets[1];
    EXPECT_EQ(budget["budget_ms"], 40.0);
    EXPECT_EQ(budget["best"], "uniform:samples=1");
    EXPECT_EQ(budget["ratios"][0]["ratio"], 1.0);
    const Json& other = budget["ratios"][1];
    const double frames = results["scenes"][0]["methods"][0]["cells"][3]["frames"];
    EXPECT_GT(frames, 4.0);
    EXPECT_NEAR(other["ratio"].get<double>(), frames, 0.1 * frames);
    EXPECT_LT(other["low"].get<double>(), frames);
    EXPECT_GT(other["high"].get<double>(), frames);
}

TEST(BenchProtocol, WhatIsOffItsBudgetOrSmallerIsNotCompared) {
    const TemporaryFolder folder;
    ToySource source(std::vector<ToyFault>(2));
    const Json results = run_toy_bench(toy_plan("uniform:samples=1,ris"), source, folder.path());
    Json methods = results["scenes"][0]["methods"];
    const auto compare = [&] { return describe_equal_time(methods)[1]; };
    Json& cell = methods[0]["cells"][3];
    cell["ms"]["median"] = 1.3 * cell["budget_ms"].get<double>();
    EXPECT_EQ(compare()["best"], "ris");
    EXPECT_TRUE(compare()["ratios"][0]["ratio"].is_null());
    EXPECT_EQ(compare()["ratios"][0]["reason"], "took 52 ms");
    cell["ms"]["median"] = cell["budget_ms"];
    EXPECT_EQ(compare()["best"], "uniform:samples=1");
    cell["resolution"] = 0.5;
    EXPECT_EQ(compare()["ratios"][0]["reason"], "drawn at 50 % of the resolution");
    methods[1]["cells"][3]["resolution"] = 0.25;
    EXPECT_TRUE(compare()["best"].is_null());
}

TEST(BenchProtocol, AMovingCameraLeavesOneFrameACell) {
    const TemporaryFolder folder;
    ToySource source(std::vector<ToyFault>(2));
    BenchPlan plan = toy_plan("uniform:samples=1,ris");
    plan.moving = true;
    const Json results = run_toy_bench(plan, source, folder.path());
    for (const Json& method : results["scenes"][0]["methods"]) {
        for (const Json& cell : method["cells"]) EXPECT_EQ(cell["frames"], 1);
        EXPECT_TRUE(method["slope"]["mean"].is_null());
    }
}

TEST(BenchProtocol, AKilledRunGoesOnAndComesToTheSameErrors) {
    const TemporaryFolder whole, broken;
    const BenchPlan plan = toy_plan("uniform,ris");
    ToySource steady(std::vector<ToyFault>(2));
    const Json expected = run_toy_bench(plan, steady, whole.path());
    // The first process ends after some sequences; a damaged note and a half-made picture lie about.
    ToySource first(std::vector<ToyFault>(2));
    const Truth truth = ToySource::make_toy_truth();
    const WorkFolder work(broken.path() / "unfinished", {{"toy", 1}});
    const std::vector<Cell> cells = plan_cells(plan, first, work);
    BenchPlan part = plan;
    part.seeds = 3;
    const std::atomic<bool> never{false};
    measure_cells(part, cells, first, truth, work, never);
    const std::string damaged = unit_name(cells[1], 1);
    std::ofstream(broken.path() / "unfinished" / (damaged + ".cbor")) << "half";
    std::ofstream(broken.path() / "unfinished" / "x.exr.1-0.part") << "half";

    ToySource second(std::vector<ToyFault>(2));
    const Json resumed = run_toy_bench(plan, second, broken.path());
    EXPECT_LT(second.rendered(), steady.rendered());
    for (const char* kind : {"first", "mean"}) {
        EXPECT_EQ(cell_of(resumed, 1, kind)["errors"], cell_of(expected, 1, kind)["errors"]) << kind;
    }
}

TEST(BenchProtocol, AnotherRunsFolderIsRefused) {
    const TemporaryFolder folder;
    const WorkFolder mine(folder.path() / "unfinished", {{"seeds", 8}});
    EXPECT_FALSE(mine.is_resumed());
    EXPECT_TRUE(WorkFolder(folder.path() / "unfinished", {{"seeds", 8}}).is_resumed());
    EXPECT_THROW(WorkFolder(folder.path() / "unfinished", {{"seeds", 9}}), std::runtime_error);
}

TEST(BenchProtocol, PixelsThatAreLeftOutCountForNothing) {
    const ReferenceResult reference = ToySource::make_reference();
    const std::vector<std::uint32_t> left_out = {3, 77};
    const Truth truth = make_truth(reference, left_out, 0.0f);
    Image picture = reference.radiance;
    for (const std::uint32_t pixel : left_out) picture.values[3 * pixel] = 1e6f;
    const PictureErrors errors = measure_picture(truth, picture);
    EXPECT_EQ(errors.linear.mse, 0.0);
    EXPECT_EQ(errors.linear.non_finite, 0u);
    picture.values[0] = std::nanf("");
    EXPECT_EQ(measure_picture(truth, picture).linear.non_finite, 1u);
}

TEST(TimeToError, IsReadOffStraightLinesOverLogarithms) {
    const std::vector<TimedError> curve = {{10, 1.0}, {20, 0.5}, {40, 0.25}};
    EXPECT_NEAR(find_time_to_error(curve, 0.5).ms, 20.0, 1e-9);
    EXPECT_NEAR(find_time_to_error(curve, std::sqrt(0.125)).ms, std::sqrt(800.0), 1e-9);
    EXPECT_EQ(find_time_to_error(curve, 2.0).kind, TimeToError::Kind::FIRST_FRAME_IS_BETTER);
    EXPECT_EQ(find_time_to_error(curve, 0.1).kind, TimeToError::Kind::NOT_REACHED);
}

}  // namespace
}  // namespace tarn::test
