// `tarn floors`: every pass of the frame stands beside its floor, and the floor of the rays is of the frame's
// very rays.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <set>

#include "support/process.h"

namespace tarn::test {
namespace {

using Json = nlohmann::ordered_json;

const std::string CORNELL = TARN_BUILD_DIR "/content/cornell.glb";

class FloorsCommand : public testing::Test {
  protected:
    Json run(const std::string& command, const std::vector<std::string>& more) const {
        const std::string file = folder_.file(command + ".json");
        std::vector<std::string> arguments = {command, CORNELL, "--size", "64x36", "--json", file};
        arguments.insert(arguments.end(), more.begin(), more.end());
        const ProcessResult result = run_tarn(arguments);
        EXPECT_EQ(result.status, 0) << result.err;
        return Json::parse(read_text(file));
    }

    TemporaryFolder folder_;
};

TEST_F(FloorsCommand, EveryPassStandsBesideItsFloor) {
    const Json floors = run("floors", {"--frames", "1", "--method", "restir-fast"});
    double sum_of_floors = 0.0;
    for (const Json& row : floors["passes"]) {
        EXPECT_GT(row["ms_median"].get<double>(), 0.0) << row.dump();
        EXPECT_GT(row["floor_ms_median"].get<double>(), 0.0) << row.dump();
        EXPECT_GT(row["ratio"].get<double>(), 0.0) << row.dump();
        EXPECT_FALSE(row["floor"].get<std::string>().empty()) << row.dump();
        if (row["name"] != "frame") sum_of_floors += row["floor_ms_median"].get<double>();
    }
    const Json& frame = floors["passes"].back();
    EXPECT_EQ(frame["name"], "frame");
    // Of a single frame: a median of sums would be no sum of medians.
    EXPECT_NEAR(frame["floor_ms_median"].get<double>(), sum_of_floors, 1e-6 * sum_of_floors);
}

// Passes that rasterize share a row, as do those that trace; all others have one each.
TEST_F(FloorsCommand, TheRowsAreThePassesOfTheFrame) {
    const Json floors = run("floors", {"--frames", "2", "--direct", "ris"});
    const Json render = run("render", {"--raw", "--direct", "ris", "--out", folder_.file("picture.png")});
    std::set<std::string> expected = {"frame"}, found;
    for (const Json& pass : render["passes"]) {
        const std::string name = pass["name"];
        const bool is_raster = name.starts_with("gbuffer/raster"), is_rays = name == "visibility";
        expected.insert(is_raster ? "gbuffer/raster" : is_rays ? "rays" : name);
    }
    for (const Json& row : floors["passes"]) found.insert(row["name"].get<std::string>());
    EXPECT_EQ(found, expected);
}

// Of another frame than the picture, whose numbers differ: some pixels' samples lie behind them, and ask no
// ray.
TEST_F(FloorsCommand, TheRaysAreThoseOfAFrame) {
    const Json floors = run("floors", {"--frames", "1", "--direct", "ris"});
    const Json render = run("render", {"--raw", "--direct", "ris", "--out", folder_.file("picture.png")});
    const double rays = render["rays"]["shadow"];
    EXPECT_GT(rays, 0.0);
    EXPECT_NEAR(floors["rays"].get<double>(), rays, 0.1 * rays);
}

}  // namespace
}  // namespace tarn::test
