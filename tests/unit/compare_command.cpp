// `tarn compare` as a person runs it: table, JSON, heat map, exit statuses.
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>

#include "image_io/image_io.h"

namespace tarn {
namespace {

namespace fs = std::filesystem;

struct ProcessResult {
    int status = -1;
    std::string output;  // of both streams
};

ProcessResult run_tarn(const std::string& arguments) {
    ProcessResult run;
    const std::string command = "\"" TARN_BUILD_DIR "/tarn\" " + arguments + " 2>&1";
    FILE* pipe = popen(command.c_str(), "r");
    if (!pipe) return run;
    std::array<char, 4096> buffer{};
    while (const std::size_t count = fread(buffer.data(), 1, buffer.size(), pipe)) {
        run.output.append(buffer.data(), count);
    }
    const int status = pclose(pipe);
    run.status = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
    return run;
}

class CompareCommand : public testing::Test {
  protected:
    void SetUp() override {
        const auto* test = testing::UnitTest::GetInstance()->current_test_info();
        folder_ = fs::temp_directory_path() /
                  (std::string("tarn_compare_") + test->name() + std::to_string(getpid()));
        fs::create_directories(folder_);
        Image reference(8, 4, 3);
        for (float& value : reference.values) value = 0.5f;
        Image image = reference;
        for (float& value : image.values) value = 0.75f;
        write_exr(folder_ / "reference.exr", reference);
        write_exr(folder_ / "image.exr", image);
        write_png(folder_ / "reference.png", reference);
        write_png(folder_ / "image.png", image);
        image.values[0] = std::nanf("");
        write_exr(folder_ / "nan.exr", image);
        write_exr(folder_ / "small.exr", Image(4, 4, 3));
    }
    void TearDown() override { fs::remove_all(folder_); }

    std::string path(const char* name) const { return (folder_ / name).string(); }

    nlohmann::json compare(const std::string& arguments) const {
        const ProcessResult run = run_tarn("compare " + arguments + " --json " + path("out.json"));
        EXPECT_EQ(run.status, 0) << run.output;
        return nlohmann::json::parse(std::ifstream(path("out.json")));
    }

    ProcessResult judge(const std::string& limits, const char* kind = "exr") const {
        const std::string extension = std::string(".") + kind;
        return run_tarn("compare " + path(("reference" + extension).c_str()) + " " +
                        path(("image" + extension).c_str()) + " " + limits + " --json " + path("out.json"));
    }

    fs::path folder_;
};

TEST_F(CompareCommand, writes_every_key) {
    const nlohmann::json json = compare(path("reference.exr") + " " + path("image.exr"));
    for (const char* key : {"mse", "rmse", "rel_mse", "rel_mse_trimmed", "rmspe", "mape", "mean_ratio",
                            "flip_ldr", "flip_hdr", "ssim", "non_finite", "exposure_ev", "width", "height"}) {
        ASSERT_TRUE(json.contains(key)) << key;
        EXPECT_TRUE(json[key].is_number()) << key;
    }
    EXPECT_NEAR(json["mse"], 0.0625, 1e-9);
    EXPECT_NEAR(json["rel_mse"], 0.0625 / 0.26, 1e-9);
    EXPECT_NEAR(json["mean_ratio"], 1.5, 1e-9);
    EXPECT_NEAR(json["exposure_ev"], std::log2(0.18 / 0.5), 1e-5);
    EXPECT_EQ(json["width"], 8);
    EXPECT_EQ(json["height"], 4);
}

TEST_F(CompareCommand, applies_the_exposure_to_the_linear_metrics) {
    const nlohmann::json json = compare(path("reference.exr") + " " + path("image.exr") + " --exposure 1");
    EXPECT_NEAR(json["mse"], 0.25, 1e-9);
    EXPECT_EQ(json["exposure_ev"], 1.0);
}

TEST_F(CompareCommand, counts_pixels_that_are_not_finite) {
    const nlohmann::json json = compare(path("reference.exr") + " " + path("nan.exr"));
    EXPECT_EQ(json["non_finite"], 1);
    EXPECT_NEAR(json["mse"], 0.0625, 1e-9);
    EXPECT_TRUE(json["flip_ldr"].is_number());
}

TEST_F(CompareCommand, takes_png_as_display_values) {
    const nlohmann::json json = compare(path("reference.png") + " " + path("image.png"));
    EXPECT_TRUE(json["flip_hdr"].is_null());
    const auto decode = [](double v) { return std::pow((v + 0.055) / 1.055, 2.4); };
    EXPECT_NEAR(json["rmse"], decode(191.0 / 255.0) - decode(128.0 / 255.0), 1e-6);
    EXPECT_GT(json["flip_ldr"].get<double>(), 0.1);
}

TEST_F(CompareCommand, prints_the_table_and_draws_the_difference) {
    const ProcessResult run = run_tarn("compare " + path("reference.exr") + " " + path("image.exr") +
                                       " --difference " + path("difference.png"));
    EXPECT_EQ(run.status, 0);
    for (const char* name : {"rel_mse", "flip_ldr", "flip_hdr", "mean_ratio"}) {
        EXPECT_NE(run.output.find(name), std::string::npos) << run.output;
    }
    EXPECT_EQ(read_png(path("difference.png")).width, 8);
}

TEST_F(CompareCommand, ends_with_one_line_where_pictures_do_not_compare) {
    for (const std::string& arguments :
         {path("reference.exr") + " " + path("small.exr"), path("reference.exr") + " " + path("image.png"),
          path("reference.exr") + " " + path("missing.exr"),
          path("reference.png") + " " + path("image.png") + " --exposure 1",
          path("reference.exr") + " " + path("image.exr") + " --json " + path("missing/out.json")}) {
        const ProcessResult run = run_tarn("compare " + arguments);
        EXPECT_EQ(run.status, 1) << arguments;
        const std::size_t error = run.output.find("tarn: ");
        ASSERT_NE(error, std::string::npos) << run.output;
        EXPECT_EQ(run.output.find('\n', error), run.output.size() - 1) << run.output;
    }
}

TEST_F(CompareCommand, ends_with_status_2_for_wrong_usage) {
    EXPECT_EQ(run_tarn("compare").status, 2);
    EXPECT_EQ(run_tarn("compare a.exr b.exr --exposure bright").status, 2);
}

// The pictures differ by 0.25: mse 0.0625, mean ratio 1.5.
TEST_F(CompareCommand, limits_decide_the_exit_status) {
    EXPECT_EQ(judge("--max mse=0.07 --max mean_ratio=1.51 --min mean_ratio=1.49").status, 0);
    const ProcessResult above = judge("--max mse=0.06 --min mean_ratio=1.49");
    EXPECT_EQ(above.status, 3);
    EXPECT_NE(above.output.find("tarn: mse is 0.0625, at most 0.06 is allowed\n"), std::string::npos)
        << above.output;
    EXPECT_NE(above.output.find("rel_mse "), std::string::npos) << "the table comes all the same";
    EXPECT_TRUE(fs::exists(path("out.json")));
    const ProcessResult two = judge("--max mse=0.06 --min mean_ratio=1.6");
    EXPECT_EQ(two.status, 3);
    EXPECT_NE(two.output.find("tarn: mean_ratio is 1.5, at least 1.6 is allowed\n"), std::string::npos)
        << two.output;
}

TEST_F(CompareCommand, pixels_that_are_not_finite_may_have_a_limit) {
    const std::string pictures = "compare " + path("reference.exr") + " " + path("nan.exr");
    EXPECT_EQ(run_tarn(pictures + " --max non_finite=1").status, 0);
    EXPECT_EQ(run_tarn(pictures + " --max non_finite=0").status, 3);
}

TEST_F(CompareCommand, limits_that_mean_nothing_are_refused) {
    for (const char* limit : {"--max beauty=1", "--max mse", "--max mse=", "--max mse=1x", "--max mse=nan"})
        EXPECT_EQ(judge(limit).status, 2) << limit;
    const ProcessResult unmeasured = judge("--max flip_hdr=0.1", "png");
    EXPECT_EQ(unmeasured.status, 1);
    EXPECT_NE(unmeasured.output.find("flip_hdr is not measured"), std::string::npos) << unmeasured.output;
}

}  // namespace
}  // namespace tarn
