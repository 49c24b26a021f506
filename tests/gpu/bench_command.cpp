// `tarn bench` on the renderer: what they promise, and what they do when they are
// killed or cannot write.
#include <gtest/gtest.h>

#include <csignal>
#include <nlohmann/json.hpp>

#include "support/browser.h"
#include "support/process.h"

namespace tarn::test {
namespace {

using Json = nlohmann::ordered_json;
using Arguments = std::vector<std::string>;

const std::string CORNELL = TARN_BUILD_DIR "/content/cornell.glb";

Arguments bench_arguments(const TemporaryFolder& folder, const std::string& methods) {
    return {tarn_program(), "bench", CORNELL,           "--methods", methods,     "--size", "64x36",
            "--seeds",      "6",     "--frames",        "16",        "--budgets", "20",     "--reference-spp",
            "512",          "--out", folder.file("out")};
}

class BenchCommand : public testing::Test {
  protected:
    void SetUp() override { setenv("TARN_CACHE_DIR", folder_.file("cache").c_str(), 1); }
    void TearDown() override { unsetenv("TARN_CACHE_DIR"); }

    ProcessResult bench(const std::string& methods, const Arguments& more = {}) const {
        Arguments arguments = bench_arguments(folder_, methods);
        arguments.insert(arguments.end(), more.begin(), more.end());
        return run_process(arguments);
    }
    Json results() const { return Json::parse(read_text(folder_.path() / "out" / "results.json")); }
    std::filesystem::path page() const { return folder_.path() / "out" / "report.html"; }

    TemporaryFolder folder_;
};

const Json& cell_of(const Json& results, std::size_t method, const std::string& kind) {
    for (const Json& cell : results["scenes"][0]["methods"][method]["cells"]) {
        if (cell["kind"] == kind) return cell;
    }
    throw std::runtime_error("no cell " + kind);
}

// The two lights of the Cornell box have the same power: choosing by power is choosing at random.
TEST_F(BenchCommand, RisWithOneCandidateIsUniform) {
    const ProcessResult result = bench("uniform,ris:candidates=1");
    ASSERT_EQ(result.status, 0) << result.err;
    const Json all = results();
    for (const char* kind : {"first", "mean"}) {
        const Json &uniform = cell_of(all, 0, kind)["errors"], &ris = cell_of(all, 1, kind)["errors"];
        for (const char* name : {"mse", "rel_mse", "mape", "mean_ratio", "flip_ldr"}) {
            EXPECT_LE(uniform[name]["low"].get<double>(), ris[name]["high"].get<double>()) << name;
            EXPECT_GE(uniform[name]["high"].get<double>(), ris[name]["low"].get<double>()) << name;
        }
    }
    for (const Json& method : all["scenes"][0]["methods"]) {
        EXPECT_NEAR(method["slope"]["mean"].get<double>(), -1.0, 0.1) << method["label"];
        EXPECT_EQ(method["cells"][0]["counts"]["bad_radiance"], 0);
    }
}

TEST_F(BenchCommand, ComparedWithItselfNothingChanges) {
    ASSERT_EQ(bench("uniform").status, 0);
    std::filesystem::copy_file(folder_.path() / "out" / "results.json", folder_.file("old.json"));
    const ProcessResult result = bench("uniform", {"--compare", folder_.file("old.json")});
    ASSERT_EQ(result.status, 0) << result.err;
    // The same seeds give the same bits; times are the machine's and no part of this test.
    const Json all = results();
    for (const Json& finding : all["comparison"]["findings"]) {
        const std::string verdict = finding["verdict"];
        EXPECT_TRUE(verdict == "slower" || verdict == "faster") << finding.dump();
    }
}

TEST_F(BenchCommand, TheReportPassesItsOwnTestInABrowser) {
    const auto browser = find_browser();
    if (!browser) GTEST_SKIP() << "no chromium here";
    ASSERT_EQ(bench("uniform,ris,restir-fast").status, 0);
    const std::filesystem::path artefacts = TARN_BUILD_DIR "/report_artefacts";
    std::filesystem::create_directories(artefacts);
    for (const int width_px : {1280, 400}) {
        EXPECT_EQ(run_page_selftest(*browser, page(), width_px), "passed") << width_px << " px";
        take_screenshot(*browser, page(), width_px,
                        artefacts / ("bench_" + std::to_string(width_px) + ".png"));
    }
}

TEST_F(BenchCommand, AKilledBenchmarkGoesOn) {
    const std::filesystem::path unfinished = folder_.path() / "out" / "unfinished" / "cornell";
    {
        Process process(bench_arguments(folder_, "uniform,ris"));
        ASSERT_TRUE(process.wait_until(
            [&] { return std::filesystem::exists(unfinished / "method0_curve_seed1.cbor"); },
            std::chrono::seconds(200)))
            << process.error_text();
        process.send(SIGKILL);
        EXPECT_EQ(process.finish().status, -1);
    }
    const auto kept = std::filesystem::last_write_time(unfinished / "method0_curve_seed0.cbor");
    // Other settings must not mix with what is there.
    const ProcessResult other = bench("uniform");
    EXPECT_EQ(other.status, 1);
    EXPECT_EQ(other.error_lines(), 1) << other.err;
    EXPECT_EQ(std::filesystem::last_write_time(unfinished / "method0_curve_seed0.cbor"), kept);
    const ProcessResult result = bench("uniform,ris");
    ASSERT_EQ(result.status, 0) << result.err;
    EXPECT_NE(result.out.find("going on"), std::string::npos) << result.out;
    EXPECT_EQ(cell_of(results(), 1, "mean")["errors"]["mse"]["per_seed"].size(), 6u);
    EXPECT_FALSE(std::filesystem::exists(unfinished));
}

// A limit on the size of files fails writes as a full disk does.
TEST_F(BenchCommand, AFullDiskIsOneLineAndLosesNothing) {
    std::string command = "trap '' XFSZ; ulimit -f 8; exec";
    for (const std::string& argument : bench_arguments(folder_, "uniform")) command += " '" + argument + "'";
    const ProcessResult full = run_process({"bash", "-c", command});
    EXPECT_EQ(full.status, 1);
    EXPECT_NE(full.err.find("cannot"), std::string::npos) << full.err;
    const ProcessResult result = bench("uniform");
    EXPECT_EQ(result.status, 0) << result.err;
}

TEST_F(BenchCommand, WrongWordsAreOneLine) {
    for (const Arguments& wrong : {Arguments{"bench", "--compare", "/none.json"},
                                   Arguments{"bench", "--out", "/proc/none"}, Arguments{"report", "/proc"}}) {
        const ProcessResult result = run_tarn(wrong);
        EXPECT_EQ(result.status, 1) << wrong.back();
        EXPECT_EQ(result.error_lines(), 1) << result.err;
    }
    EXPECT_EQ(run_tarn({"bench", "--frames", "5"}).status, 2);
    const ProcessResult usage = run_tarn({"bench", "--methods", "nobody"});
    EXPECT_EQ(usage.status, 2);
    EXPECT_EQ(usage.error_lines(), 1) << usage.err;
}

}  // namespace
}  // namespace tarn::test
