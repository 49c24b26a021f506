// `tarn render` and `tarn flythrough` as a person meets them: the report's keys, outputs that cannot be
// written, Ctrl-C.
#include <gtest/gtest.h>

#include <csignal>
#include <nlohmann/json.hpp>
#include <set>

#include "image_io/image_io.h"
#include "support/process.h"

namespace tarn::test {
namespace {

using Arguments = std::vector<std::string>;

const std::string CORNELL = TARN_BUILD_DIR "/content/cornell.glb";

nlohmann::json read_json(const std::filesystem::path& file) {
    return nlohmann::json::parse(read_text(file));
}

// What is promised to whoever reads the reports.
void expect_report(const nlohmann::json& report) {
    for (const char* key : {"median", "p95"}) EXPECT_GT(report.at("frame_ms").at(key), 0.0) << key;
    ASSERT_GE(report.at("passes").size(), 5u);
    for (const nlohmann::json& pass : report["passes"]) {
        EXPECT_FALSE(pass.at("name").get<std::string>().empty());
        EXPECT_GE(pass.at("ms_median"), 0.0);
    }
    EXPECT_GT(report.at("rays").at("shadow"), 0);
    EXPECT_TRUE(report["rays"].at("closest").is_number());
    EXPECT_FALSE(report.at("counters").empty());
    for (const auto& [name, value] : report["counters"].items()) EXPECT_EQ(value, 0) << name;
    for (const char* key : {"cpu", "mesa", "embree"})
        EXPECT_TRUE(report.at("machine").at(key).is_string()) << key;
    EXPECT_EQ(report["machine"].at("threads"), 2);
    for (const char* key : {"width", "height", "seed", "direct", "candidates", "context"}) {
        EXPECT_TRUE(report.at("settings").contains(key)) << key;
    }
}

TEST(RenderCommand, ReportsWhatItPromises) {
    for (const char* frames : {"1", "3"}) {
        const TemporaryFolder folder;
        const ProcessResult result = run_tarn(
            {"render", CORNELL, "--raw", "--out", folder.file("a.exr"), "--size", "64x36", "--threads", "2",
             "--frames", frames, "--seed", "9", "--direct", "uniform", "--json", folder.file("a.json")});
        ASSERT_EQ(result.status, 0) << result.err;
        const nlohmann::json report = read_json(folder.file("a.json"));
        expect_report(report);
        EXPECT_EQ(report["settings"]["width"], 64);
        EXPECT_EQ(report["settings"]["seed"], 9);
        EXPECT_EQ(report["settings"]["direct"], "uniform");
        EXPECT_EQ(read_radiance(folder.file("a.exr")).height, 36);
    }
}

TEST(RenderCommand, ExposureAppliesToPngAlone) {
    const TemporaryFolder folder;
    const auto render = [&](const std::string& name, const std::string& exposure) {
        const ProcessResult result = run_tarn({"render", CORNELL, "--raw", "--out", folder.file(name),
                                               "--size", "32x18", "--exposure", exposure});
        EXPECT_EQ(result.status, 0) << result.err;
        return folder.file(name);
    };
    EXPECT_EQ(read_radiance(render("dark.exr", "0")).values, read_radiance(render("bright.exr", "3")).values);
    const Image dark = read_png(render("dark.png", "0")), bright = read_png(render("bright.png", "3"));
    double dark_sum = 0.0, bright_sum = 0.0;
    for (std::size_t i = 0; i < dark.values.size(); ++i) {
        dark_sum += dark.values[i];
        bright_sum += bright.values[i];
    }
    EXPECT_GT(bright_sum, 1.5 * dark_sum);
}

TEST(RenderCommand, EndsWithOneLineWhereItCannotWrite) {
    const TemporaryFolder folder;
    std::filesystem::create_directory(folder.path() / "closed");
    std::filesystem::permissions(folder.path() / "closed", std::filesystem::perms::owner_read);
    // Root may write into any folder but those of the kernel.
    const std::string closed = geteuid() == 0 ? "/proc" : folder.file("closed");
    const Arguments render = {"render", CORNELL, "--size", "16x16", "--out"};
    for (const auto& [out, json] : {std::pair(closed + "/a.png", folder.file("a.json")),
                                    std::pair(closed + "/a.exr", folder.file("a.json")),
                                    std::pair(folder.file("a.png"), closed + "/a.json"),
                                    std::pair(folder.file("b.png"), folder.path().string())}) {
        Arguments arguments = render;
        arguments.insert(arguments.end(), {out, "--json", json});
        const ProcessResult result = run_tarn(arguments);
        EXPECT_EQ(result.status, 1) << out;
        EXPECT_EQ(result.error_lines(), 1) << result.err;
    }
    const ProcessResult result = run_tarn({"flythrough", "--frames", "1", "--out", closed + "/fly"});
    EXPECT_EQ(result.status, 1);
    EXPECT_EQ(result.error_lines(), 1) << result.err;
}

TEST(RenderCommand, AnUnknownCameraIsOneLineWithTheNames) {
    const TemporaryFolder folder;
    const ProcessResult result =
        run_tarn({"render", CORNELL, "--out", folder.file("a.png"), "--camera", "nobody"});
    EXPECT_EQ(result.status, 1);
    EXPECT_EQ(result.error_lines(), 1) << result.err;
    EXPECT_NE(result.err.find("'main'"), std::string::npos) << result.err;
}

// Every picture can be read and nothing half-written lies about.
void expect_whole_files(const std::filesystem::path& folder) {
    int pictures = 0;
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
        if (entry.path().extension() == ".png") {
            EXPECT_EQ(read_png(entry.path()).width, 64) << entry.path();
            ++pictures;
        } else {
            const std::set<std::string> others = {"report.json", "results.json", "report.html", "unfinished"};
            EXPECT_TRUE(others.contains(entry.path().filename().string())) << entry.path();
        }
    }
    EXPECT_GT(pictures, 0);
}

TEST(FlythroughCommand, WritesPicturesErrorsAndAReport) {
    const TemporaryFolder folder;
    const ProcessResult result =
        run_tarn({"flythrough", CORNELL, "--raw", "--out", folder.file("fly"), "--size", "64x36", "--threads",
                  "2", "--frames", "4", "--pictures", "2", "--measured", "1", "--reference-spp", "4",
                  "--json", folder.file("also.json")});
    ASSERT_EQ(result.status, 0) << result.err;
    expect_whole_files(folder.path() / "fly");
    const nlohmann::json report = read_json(folder.path() / "fly" / "report.json");
    EXPECT_EQ(report, read_json(folder.file("also.json")));
    EXPECT_EQ(report.at("interrupted"), false);
    ASSERT_EQ(report.at("errors").size(), 1u);
    for (const char* key : {"frame", "mse", "rel_mse", "mape", "mean_ratio", "flip_ldr"}) {
        EXPECT_TRUE(report["errors"][0].contains(key)) << key;
    }
}

TEST(RenderCommand, CtrlCKeepsTheMeanSoFar) {
    const TemporaryFolder folder;
    Process process({tarn_program(), "render", "cornell", "--accumulate", "--frames", "1000000", "--size",
                     "64x36", "--out", folder.file("a.exr")});
    ASSERT_TRUE(process.wait_until([&] { return !process.error_text().empty(); }, std::chrono::seconds(60)));
    process.send(SIGINT);
    const ProcessResult result = process.finish();
    EXPECT_EQ(result.status, 130) << result.err;
    EXPECT_TRUE(std::filesystem::exists(folder.file("a.exr"))) << result.err;
}

TEST(FlythroughCommand, CtrlCLeavesWholeFilesAndAReport) {
    const TemporaryFolder folder;
    const std::filesystem::path out = folder.path() / "fly";
    Process process({tarn_program(), "flythrough", "--raw", "--out", out.string(), "--size", "64x36",
                     "--threads", "2", "--frames", "100000", "--pictures", "100000", "--measured", "0"});
    ASSERT_TRUE(process.wait_until([&] { return std::filesystem::exists(out / "frame_0002.png"); },
                                   std::chrono::seconds(120)))
        << process.error_text();
    process.send(SIGINT);
    const ProcessResult result = process.finish();
    EXPECT_EQ(result.status, 130) << result.err;
    expect_whole_files(out);
    const nlohmann::json report = read_json(out / "report.json");
    expect_report(report);
    EXPECT_EQ(report.at("interrupted"), true);
}

}  // namespace
}  // namespace tarn::test
