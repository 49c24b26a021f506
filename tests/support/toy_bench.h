// A whole benchmark over a ToySource: from sequences to results.
#pragma once

#include "bench/bench_run.h"
#include "bench/equal_time.h"
#include "bench/results.h"
#include "core/log.h"
#include "support/process.h"
#include "support/toy_source.h"

namespace tarn::test {

inline BenchPlan toy_plan(const std::string& methods) {
    BenchPlan plan;
    plan.methods = parse_methods(methods);
    plan.budgets_ms = {12.0, 40.0};
    plan.seeds = 8;
    plan.frames = 16;
    return plan;
}

// Results as `tarn bench` would write them, of one scene.
inline nlohmann::ordered_json run_toy_bench(const BenchPlan& plan, FrameSource& source,
                                            const std::filesystem::path& folder) {
    set_quiet(true);
    const std::atomic<bool> never{false};
    const Truth truth = ToySource::make_toy_truth();
    const WorkFolder work(folder / "unfinished", {{"toy", 1}});
    const std::vector<Cell> cells = plan_cells(plan, source, work);
    measure_cells(plan, cells, source, truth, work, never);
    nlohmann::ordered_json scene = {{"name", "toy"}, {"camera", ""}};
    scene["width"] = ToySource::WIDTH_PX;
    scene["height"] = ToySource::HEIGHT_PX;
    scene["reference"] = describe_truth(truth, folder, "toy");
    scene["methods"] = describe_methods(plan, cells, truth, work, folder, "toy");
    scene["equal_error"] = describe_equal_error(scene["methods"]);
    scene["equal_time"] = describe_equal_time(scene["methods"]);
    nlohmann::ordered_json results = {{"format", RESULTS_FORMAT}, {"version", RESULTS_VERSION}};
    results["scenes"] = nlohmann::ordered_json::array({scene});
    return results;
}

}  // namespace tarn::test
