// `tarn study` and a benchmark with a moving camera, end to end on small pictures.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "support/process.h"

namespace tarn::test {
namespace {

using Json = nlohmann::ordered_json;
using Arguments = std::vector<std::string>;

const std::string CONTENT = TARN_BUILD_DIR "/content/";

class StudyCommand : public testing::Test {
  protected:
    void SetUp() override { setenv("TARN_CACHE_DIR", folder_.file("cache").c_str(), 1); }
    void TearDown() override { unsetenv("TARN_CACHE_DIR"); }

    // Runs it and returns the JSON that it wrote.
    Json study(const std::string& question, const Arguments& more) const {
        Arguments arguments = {tarn_program(), "study", question, "--json", folder_.file("study.json")};
        arguments.insert(arguments.end(), more.begin(), more.end());
        const ProcessResult result = run_process(arguments);
        EXPECT_EQ(result.status, 0) << result.err;
        return Json::parse(read_text(folder_.path() / "study.json"));
    }

    TemporaryFolder folder_;
};

TEST_F(StudyCommand, AveragingLowersTheNoiseOfVisibilityAndKeepsTheSamples) {
    const Json found =
        study("visibility", {CONTENT + "coloured_lights.glb", "--size", "48x27", "--seeds", "6", "--frames",
                             "2", "--reference-spp", "64", "--out", folder_.file("out")});
    EXPECT_EQ(found["noise"]["same_samples"], 1.0);
    EXPECT_LT(found["noise"]["variance_ratio"]["high"].get<double>(), 0.8);
    EXPECT_TRUE(std::filesystem::exists(folder_.path() / "out" / "visibility_averaged.png"));
}

TEST_F(StudyCommand, TheBoilingFilterRemovesEnergyAndMirroringRemovesNone) {
    const Json found = study("options", {CONTENT + "coloured_lights.glb", "--size", "48x27", "--seeds", "8",
                                         "--warm-up", "8", "--frames", "4"});
    for (const Json& option : found["options"]) {
        const Json& energy = option["energy_added_percent"];
        if (option["setting"] == "boiling-filter") {
            EXPECT_LT(energy["high"].get<double>(), 0.0) << option.dump();
        }
        if (option["setting"] == "mirror") {
            EXPECT_NEAR(energy["mean"].get<double>(), 0.0, 1.0) << option.dump();
        }
    }
}

// Without a past there is no lag; with one, it is the noise that takes its time.
TEST_F(StudyCommand, LagIsOfWhatHasAPast) {
    const Json found =
        study("lag", {CONTENT + "coloured_lights.glb", "--size", "48x27", "--seeds", "4", "--warm-up", "20",
                      "--frames", "24", "--methods", "ris:samples=32,restir-balanced"});
    for (const Json& step : found["steps"]) {
        EXPECT_EQ(step["progress"].size(), 24u);
        EXPECT_NEAR(step["progress"].back().get<double>(), 1.0, 0.2) << step["step"];
        if (step["method"] == "ris:samples=32") {
            EXPECT_EQ(step["frames_to_reach"], 1) << step["step"];
        }
        if (step["method"] == "restir-balanced" && step["step"] == "the camera cuts") {
            EXPECT_GT(step["noise"][0].get<double>(), 1.5 * step["noise"].back().get<double>());
        }
    }
    EXPECT_EQ(found["steps"].size(), 6u);  // nothing there is animated
}

TEST_F(StudyCommand, CountsOfLightsAreRenderedSideBySide) {
    const Json found = study("lights", {"--counts", "10,100,1000", "--size", "48x27", "--frames", "3"});
    ASSERT_EQ(found["counts"].size(), 3u);
    EXPECT_EQ(found["counts"][2]["lights"], 1000);
    EXPECT_EQ(found["counts"][1]["ratio"], 1.0);
}

TEST_F(StudyCommand, NeedsReuseAndSaysSo) {
    const ProcessResult result =
        run_process({tarn_program(), "study", "visibility", CONTENT + "cornell.glb", "--direct", "ris"});
    EXPECT_EQ(result.status, 1);
    EXPECT_NE(result.err.find("needs --direct restir"), std::string::npos) << result.err;
}

TEST_F(StudyCommand, ABenchmarkWithAMovingCameraMeasuresOneFrame) {
    const ProcessResult result = run_process({tarn_program(),
                                              "bench",
                                              CONTENT + "cornell.glb",
                                              "--methods",
                                              "uniform,restir-fast",
                                              "--size",
                                              "48x27",
                                              "--seeds",
                                              "3",
                                              "--budgets",
                                              "10",
                                              "--warm-up",
                                              "4",
                                              "--walk",
                                              "0.3",
                                              "--turn",
                                              "20",
                                              "--reference-spp",
                                              "64",
                                              "--out",
                                              folder_.file("out")});
    ASSERT_EQ(result.status, 0) << result.err;
    const Json results = Json::parse(read_text(folder_.path() / "out" / "results.json"));
    for (const Json& method : results["scenes"][0]["methods"]) {
        for (const Json& cell : method["cells"]) EXPECT_EQ(cell["frames"], 1);
    }
    EXPECT_EQ(results["scenes"][0]["equal_time"].size(), 1u);
    EXPECT_NE(result.out.find("at 10 ms: relMSE"), std::string::npos) << result.out;
}

}  // namespace
}  // namespace tarn::test
