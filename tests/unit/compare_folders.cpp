// `tarn compare GOLDENS ACTUAL` with folders: a verdict for each picture, limits, exit statuses, JSON.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>

#include "image_io/image_io.h"
#include "support/process.h"

namespace tarn {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

// A lit floor: smooth, and bright at `lamp_x` of its width.
Image make_picture(float lamp_x = 0.3f, float strength = 1.0f) {
    Image image(96, 64, 3);
    for (int y = 0; y < image.height; ++y) {
        for (int x = 0; x < image.width; ++x) {
            const float dx = float(x) / 96.0f - lamp_x, dy = float(y) / 96.0f - 0.3f;
            const float light = strength * (0.05f + 0.08f / (0.04f + dx * dx + dy * dy));
            for (int c = 0; c < 3; ++c) image.pixel(x, y)[c] = light * (1.0f - 0.2f * float(c));
        }
    }
    return image;
}

// Each pixel up or down by `share`, as a checkerboard.
Image add_noise(Image image, float share) {
    for (int y = 0; y < image.height; ++y) {
        for (int x = 0; x < image.width; ++x) {
            for (int c = 0; c < 3; ++c) image.pixel(x, y)[c] *= 1.0f + ((x + y) % 2 ? share : -share);
        }
    }
    return image;
}

Image make_display(float value, int width = 32) {
    Image image(width, 32, 3);
    for (float& v : image.values) v = value;
    return image;
}

class CompareFolders : public testing::Test {
  protected:
    void SetUp() override {
        for (const char* name : {"goldens/sub", "actual/sub"}) fs::create_directories(folder_.file(name));
    }

    std::string file(const std::string& name) const { return folder_.file(name); }
    void golden(const std::string& name, const Image& image) const { write(file("goldens/" + name), image); }
    void actual(const std::string& name, const Image& image) const { write(file("actual/" + name), image); }
    void both(const std::string& name) const {
        golden(name, make_picture());
        actual(name, make_picture());
    }

    test::ProcessResult compare(std::vector<std::string> options = {}) const {
        options.insert(options.begin(),
                       {"compare", file("goldens"), file("actual"), "--json", file("out.json")});
        return test::run_tarn(options);
    }

    Json json() const { return Json::parse(test::read_text(file("out.json"))); }

    Json picture(const std::string& name) const {
        const Json all = json();
        for (const Json& entry : all["pictures"]) {
            if (entry["name"] == name) return entry;
        }
        return {};
    }

    // The one line of the table that begins with this name.
    static std::string row(const test::ProcessResult& result, const std::string& name) {
        std::istringstream lines(result.out);
        for (std::string line; std::getline(lines, line);) {
            if (line.starts_with(name + " ")) return line;
        }
        return "";
    }

  private:
    static void write(const fs::path& path, const Image& image) {
        path.extension() == ".png" ? write_png(path, image) : write_exr(path, image);
    }

    test::TemporaryFolder folder_;
};

TEST_F(CompareFolders, EqualPicturesPass) {
    both("a.exr");
    both("sub/a.exr");
    both("sub/B.PNG.exr");
    golden("c.png", make_display(0.5f));
    actual("c.png", make_display(0.5f));
    const auto result = compare();
    EXPECT_EQ(result.status, 0) << result.out << result.err;
    EXPECT_EQ(result.err, "");
    EXPECT_NE(result.out.find("\n4 pictures: 4 passed\n"), std::string::npos) << result.out;
    EXPECT_NE(row(result, "sub/a.exr").find("passed"), std::string::npos) << result.out;
    EXPECT_EQ(picture("sub/a.exr")["measured"]["mse"], 0.0);
    EXPECT_EQ(picture("sub/a.exr")["measured"]["width"], 96);
}

// What the documentation promises of the default limits.
TEST_F(CompareFolders, DefaultLimitsFindTwoPercentMoreLightButNotFaintNoise) {
    golden("bright.exr", make_picture());
    actual("bright.exr", make_picture(0.3f, 1.02f));
    golden("noisy.exr", make_picture());
    actual("noisy.exr", add_noise(make_picture(), 0.01f));
    golden("moved.exr", make_picture());
    actual("moved.exr", make_picture(0.35f));
    both("same.exr");
    EXPECT_EQ(compare().status, 3);
    EXPECT_EQ(picture("same.exr")["verdict"], "passed");
    EXPECT_EQ(picture("noisy.exr")["verdict"], "passed");
    EXPECT_GT(picture("noisy.exr")["measured"]["flip"], 0.0);
    EXPECT_EQ(picture("bright.exr")["verdict"], "failed");
    EXPECT_EQ(picture("bright.exr")["beyond"][0]["key"], "flip");
    EXPECT_EQ(picture("bright.exr")["beyond"][0]["max"], 0.01);
    EXPECT_EQ(picture("moved.exr")["verdict"], "failed");
}

// 100 of 40 000 pixels: the mean of the picture hardly moves.
TEST_F(CompareFolders, DefaultLimitsFindASmallThingThatVanished) {
    Image room(200, 200, 3);
    for (float& value : room.values) value = 0.2f;
    Image with_thing = room;
    for (int y = 75; y < 85; ++y) {
        for (int x = 75; x < 85; ++x) with_thing.pixel(x, y)[0] = 0.8f;
    }
    golden("thing.exr", with_thing);
    actual("thing.exr", room);
    EXPECT_EQ(compare().status, 3);
    EXPECT_LT(picture("thing.exr")["measured"]["flip"], 0.01);
    ASSERT_EQ(picture("thing.exr")["beyond"].size(), 1u);
    EXPECT_EQ(picture("thing.exr")["beyond"][0]["key"], "flip_tile");
}

// Of a width that is no multiple of 16: the last square reaches to the border.
TEST_F(CompareFolders, TheWorstSquareReachesTheBorder) {
    Image image = make_display(0.5f, 40);
    golden("a.png", image);
    for (int x = 36; x < 40; ++x) {
        for (int y = 0; y < 32; ++y) image.pixel(x, y)[1] = 1.0f;
    }
    actual("a.png", image);
    compare();
    const Json measured = picture("a.png")["measured"];
    // A quarter of the last square is affected and a tenth of the picture.
    EXPECT_NEAR(measured["flip_tile"].get<double>() / measured["flip"].get<double>(), 2.5, 0.15) << measured;
}

TEST_F(CompareFolders, APixelThatIsNotFiniteFails) {
    Image image = make_picture();
    golden("a.exr", image);
    image.values[30] = std::nanf("");
    actual("a.exr", image);
    EXPECT_EQ(compare().status, 3);
    EXPECT_EQ(picture("a.exr")["beyond"][0]["key"], "non_finite");
    for (float& value : image.values) value = std::nanf("");
    actual("a.exr", image);
    EXPECT_EQ(compare().status, 3) << "a picture without a finite pixel";
    EXPECT_EQ(picture("a.exr")["verdict"], "failed");
}

TEST_F(CompareFolders, EachThingThatIsWrongHasItsOwnVerdictAndStopsNothing) {
    golden("broken.exr", make_picture());
    std::ofstream(file("actual/broken.exr")) << "no picture";
    actual("extra.png", make_display(0.5f));
    golden("kind.exr", make_picture());
    actual("kind.png", make_display(0.5f));
    golden("link.exr", make_picture());
    fs::create_symlink("nowhere", file("actual/link.exr"));
    golden("missing.exr", make_picture());
    golden("size.png", make_display(0.5f, 32));
    actual("size.png", make_display(0.5f, 16));
    std::ofstream(file("goldens/torn.png")) << "no picture";
    actual("torn.png", make_display(0.5f));
    both("whole.exr");
    std::ofstream(file("goldens/notes.txt")) << "no picture either";

    const auto result = compare();
    EXPECT_EQ(result.status, 3);
    EXPECT_EQ(result.err, "tarn: 7 of 8 pictures did not pass\n");
    EXPECT_NE(result.out.find(
                  "\n8 pictures: 1 passed, 1 missing, 1 extra, 1 other size, 1 other kind, 3 unreadable\n"),
              std::string::npos)
        << result.out;
    for (const auto& [name, verdict] :
         std::vector<std::pair<std::string, std::string>>{{"broken.exr", "unreadable"},
                                                          {"extra.png", "extra"},
                                                          {"kind.exr", "other kind"},
                                                          {"link.exr", "unreadable"},
                                                          {"missing.exr", "missing"},
                                                          {"size.png", "other size"},
                                                          {"torn.png", "unreadable"},
                                                          {"whole.exr", "passed"}}) {
        EXPECT_EQ(picture(name)["verdict"], verdict) << name;
        EXPECT_NE(row(result, name).find(verdict), std::string::npos) << result.out;
    }
    EXPECT_EQ(picture("size.png")["message"], "16 x 32 pixels, expected are 32 x 32");
    EXPECT_NE(picture("kind.exr")["message"].get<std::string>().find("kind.png"), std::string::npos);
    EXPECT_NE(picture("torn.png")["message"].get<std::string>().find("goldens/torn.png"), std::string::npos);
    EXPECT_TRUE(picture("missing.exr")["measured"].is_null());
    EXPECT_EQ(json()["counts"]["unreadable"], 3);
}

// Where a.exr and a.png are both goldens, the a.png that is there is no a.exr of another kind.
TEST_F(CompareFolders, APictureStandsForOneGoldenAlone) {
    golden("a.exr", make_picture());
    golden("a.png", make_display(0.5f));
    actual("a.png", make_display(0.5f));
    golden("b.exr", make_picture());
    golden("b.hdr.exr", make_picture());
    actual("b.hdr.exr", make_picture());
    golden("c.exr", make_picture());
    golden("c.png", make_display(0.5f));
    std::ofstream(file("actual/c.hdr")) << "whatever it is";
    EXPECT_EQ(compare().status, 3);
    EXPECT_EQ(json()["counts"]["other kind"], 1);
    EXPECT_EQ(picture("a.exr")["verdict"], "missing");
    EXPECT_EQ(picture("a.png")["verdict"], "passed");
    EXPECT_EQ(picture("b.exr")["verdict"], "missing");
    EXPECT_EQ(json()["pictures"].size(), 6u);
}

TEST_F(CompareFolders, LimitsOfTheUserTakeThePlaceOfTheDefaultOnes) {
    golden("a.exr", make_picture());
    actual("a.exr", make_picture(0.3f, 1.02f));
    const auto lenient = compare({"--max", "flip=0.2"});
    EXPECT_EQ(lenient.status, 0) << lenient.out;
    EXPECT_NE(row(lenient, "a.exr").find("at most 0.2"), std::string::npos) << lenient.out;
    const auto strict =
        compare({"--max", "flip=0.2", "--max", "mean_ratio=1.01", "--min", "mean_ratio=1.019"});
    EXPECT_EQ(strict.status, 3);
    const std::string line = row(strict, "a.exr");
    EXPECT_NE(line.find("mean_ratio"), std::string::npos) << line;
    EXPECT_NE(line.find("1.02"), std::string::npos) << line;
    EXPECT_NE(line.find("at most 1.01"), std::string::npos) << line;
    EXPECT_EQ(picture("a.exr")["beyond"].size(), 1u);
    EXPECT_EQ(json()["limits"].size(), 3u);
    EXPECT_EQ(json()["limits"][2]["min"], 1.019);
}

// One line and status 1, and no report: there was nothing to judge, or it would mean nothing.
TEST_F(CompareFolders, ThereMustBeSomethingToCompare) {
    const auto expect_error = [&](const std::vector<std::string>& arguments, const std::string& text) {
        const auto result = test::run_tarn(arguments);
        EXPECT_EQ(result.status, 1) << text;
        EXPECT_EQ(result.error_lines(), 1) << result.err;
        EXPECT_NE(result.err.find(text), std::string::npos) << result.err;
    };
    const std::string goldens = file("goldens"), other = file("actual"), junit = file("junit.xml");
    expect_error({"compare", goldens, other, "--junit", junit}, goldens + ": holds no picture");
    golden("a.png", make_display(0.5f));
    expect_error({"compare", goldens, other, "--junit", junit}, other + ": holds no picture");
    actual("a.png", make_display(0.5f));
    expect_error({"compare", goldens, goldens}, "is compared with itself");
    expect_error({"compare", goldens, goldens + "/sub"}, "lies within");
    expect_error({"compare", goldens, goldens + "/a.png"}, "a folder compares only with a folder");
    expect_error({"compare", goldens, file("nowhere")}, file("nowhere") + ": no such file or folder");
    expect_error({"compare", goldens, other, "--max", "flip_hdr=0.1"}, "flip_hdr");
    expect_error({"compare", goldens, other, "--html", other + "/page"}, "lies within");
    expect_error({"compare", goldens, other, "--junit", file("nowhere/junit.xml")}, "does not exist");
    EXPECT_FALSE(fs::exists(junit));
    EXPECT_EQ(compare().status, 0) << "all the same the folders compare";
}

// Half a report would look like one in which the rest passed.
TEST_F(CompareFolders, ControlCLeavesNoReport) {
    golden("0.exr", Image(640, 640, 3));
    actual("0.exr", make_picture());
    for (int i = 1; i < 20; ++i) {
        for (const char* folder : {"goldens", "actual"})
            fs::copy_file(file("goldens/0.exr"), file(fmt::format("{}/{}.exr", folder, i)));
    }
    test::Process process({test::tarn_program(), "compare", file("goldens"), file("actual"), "--html",
                           file("page"), "--junit", file("junit.xml"), "--json", file("out.json")});
    // The first picture has another size: it is on the page at once.
    ASSERT_TRUE(process.wait_until([&] { return fs::exists(file("page/pictures/0.exr.actual.png")); },
                                   std::chrono::seconds(60)))
        << process.error_text();
    process.send(SIGINT);
    const test::ProcessResult result = process.finish();
    EXPECT_EQ(result.status, 130) << result.out;
    EXPECT_NE(result.err.find(" of 20 pictures; no report was written\n"), std::string::npos) << result.err;
    for (const char* name : {"page/index.html", "junit.xml", "out.json"})
        EXPECT_FALSE(fs::exists(file(name))) << name;
}

TEST_F(CompareFolders, OptionsOfOneFormAreWrongUsageInTheOther) {
    both("a.exr");
    const std::string goldens = file("goldens"), other = file("actual");
    const std::string one = goldens + "/a.exr", two = other + "/a.exr";
    EXPECT_EQ(test::run_tarn({"compare", goldens, other, "--difference", file("d.png")}).status, 2);
    EXPECT_EQ(test::run_tarn({"compare", one, two, "--junit", file("j.xml")}).status, 2);
    EXPECT_EQ(test::run_tarn({"compare", one, two, "--html", file("page")}).status, 2);
    EXPECT_FALSE(fs::exists(file("page")));
}

TEST_F(CompareFolders, SlashesAndDotsInTheFoldersChangeNoName) {
    both("sub/a.exr");
    const auto result =
        test::run_tarn({"compare", file("goldens/./"), file("actual/sub/..//"), "--json", file("out.json")});
    EXPECT_EQ(result.status, 0) << result.err;
    EXPECT_EQ(picture("sub/a.exr")["verdict"], "passed");
}

TEST_F(CompareFolders, HelpNamesTheDefaultLimits) {
    const auto help = test::run_tarn({"compare", "--help"});
    EXPECT_NE(help.out.find("--max flip=0.01 --max flip_tile=0.1 --max non_finite=0"), std::string::npos)
        << help.out;
}

}  // namespace
}  // namespace tarn
