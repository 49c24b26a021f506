// The report in a real browser: it passes its own test wide and narrow, and that test finds what is broken.
#include "bench/report.h"

#include <gtest/gtest.h>

#include "support/browser.h"
#include "support/toy_bench.h"

namespace tarn::test {
namespace {

void replace_once(std::string& text, const std::string& what, const std::string& with) {
    const std::size_t at = text.find(what);
    ASSERT_NE(at, std::string::npos) << what;
    text.replace(at, what.size(), with);
}

class ReportPage : public testing::Test {
  protected:
    void SetUp() override {
        const auto found = find_browser();
        if (!found) GTEST_SKIP() << "no chromium here";
        browser_ = *found;
        ToySource source(std::vector<ToyFault>(2));
        nlohmann::ordered_json results = run_toy_bench(toy_plan("uniform,ris"), source, folder_.path());
        results["machine"] = {{"cpu", "a </script> CPU"}, {"cores", 2},    {"threads", 2},
                              {"gl_renderer", "toy"},     {"mesa", "1.0"}, {"embree", "3"}};
        results["settings"] = {{"seeds", 8}};
        write_report(page(), {{results, folder_.path()}});
    }
    std::filesystem::path page() const { return folder_.path() / "report.html"; }

    // Writes the page with one thing changed and returns its verdict.
    std::string verdict_after(const std::string& what, const std::string& with) const {
        std::string text = read_text(page());
        replace_once(text, what, with);
        const std::filesystem::path changed = folder_.path() / "changed.html";
        std::ofstream(changed) << text;
        return run_page_selftest(browser_, changed, 1280);
    }

    TemporaryFolder folder_;
    std::string browser_;
};

TEST_F(ReportPage, PassesItsOwnTestWideAndNarrow) {
    const std::filesystem::path artefacts = TARN_BUILD_DIR "/report_artefacts";
    std::filesystem::create_directories(artefacts);
    for (const int width_px : {1280, 400}) {
        EXPECT_EQ(run_page_selftest(browser_, page(), width_px), "passed") << width_px << " px";
        const auto picture = artefacts / ("toy_" + std::to_string(width_px) + ".png");
        take_screenshot(browser_, page(), width_px, picture);
        EXPECT_TRUE(std::filesystem::exists(picture));
    }
}

TEST_F(ReportPage, NegativeControlsAreFound) {
    EXPECT_NE(verdict_after("canvas.chart = new Chart(canvas, makeConfiguration()); };", "};"), "passed");
    EXPECT_NE(verdict_after("this.state.showsB = !this.state.showsB;", ""), "passed");
    EXPECT_NE(verdict_after("this.state.split = Math.min(1, Math.max(0, share));", ""), "passed");
    EXPECT_NE(verdict_after("makePage();\n", "console.error('planted'); makePage();\n"), "passed");
    EXPECT_NE(verdict_after("makePage();\n",
                            "makePage(); document.body.style.width = '3000px';"
                            "document.body.style.maxWidth = 'none';\n"),
              "passed");
}

TEST_F(ReportPage, NeedsNothingFromOutside) {
    const std::string text = read_text(page());
    for (const char* link : {"src=\"http", "href=\"http", "url(http", "@import", "fetch(\"http"}) {
        EXPECT_EQ(text.find(link), std::string::npos) << link;
    }
}

TEST(LoadResults, SaysWhatIsWrongWithAFile) {
    const TemporaryFolder folder;
    const auto message = [&](const std::string& text) -> std::string {
        std::ofstream(folder.file("results.json")) << text;
        try {
            load_results(folder.path());
        } catch (const std::exception& error) {
            return error.what();
        }
        return "";
    };
    EXPECT_NE(message("{").find("is not a results.json"), std::string::npos);
    EXPECT_NE(message(R"({"format": "other"})").find("is not a results.json"), std::string::npos);
    EXPECT_NE(message(R"({"format": "tarn-results", "version": 99})").find("version 99"), std::string::npos);
    EXPECT_THROW(load_results(folder.path() / "nowhere"), std::runtime_error);
}

}  // namespace
}  // namespace tarn::test
