// `tarn flythrough` on the renderer: what moves along the path, a flight that was stopped, and its video.
#include <gtest/gtest.h>

#include <csignal>
#include <nlohmann/json.hpp>

#include "support/process.h"

namespace tarn::test {
namespace {

using Json = nlohmann::ordered_json;
using Arguments = std::vector<std::string>;

// Of content/flythroughs/lantern_court.json, the default.
constexpr double PATH_DURATION_S = 10.0;

class FlythroughCommand : public testing::Test {
  protected:
    void SetUp() override { setenv("TARN_CACHE_DIR", folder_.file("cache").c_str(), 1); }
    void TearDown() override { unsetenv("TARN_CACHE_DIR"); }

    Json results() const { return Json::parse(read_text(folder_.path() / "out" / "results.json")); }

    // A script of this name goes before all other programs.
    void put_first_on_path(const std::string& name, const std::string& script) {
        const std::filesystem::path bin = folder_.path() / "bin", file = bin / name;
        std::filesystem::create_directories(bin);
        std::ofstream(file) << "#!/bin/sh\n" << script << "\n";
        std::filesystem::permissions(file, std::filesystem::perms::owner_all);
    }

    // A short flight with `pictures` pictures, which finds programs in the folder above first.
    ProcessResult fly(int pictures) const {
        return run_process({"env", "PATH=" + folder_.file("bin") + ":" + std::getenv("PATH"), tarn_program(),
                            "flythrough", "--methods", "ris", "--size", "65x37", "--frames", "12",
                            "--pictures", std::to_string(pictures), "--measured", "0", "--exposure", "0",
                            "--out", folder_.file("out")});
    }
    std::filesystem::path video() const { return folder_.path() / "out" / "flythrough.mp4"; }

    TemporaryFolder folder_;
};

// A lamp and a block move along with the camera, and the reference with them: were one of the two to lag,
// light and shadows would lie elsewhere.
TEST_F(FlythroughCommand, LightsAndObjectsOfAPathMove) {
    const std::string path = TARN_SOURCE_DIR "/content/flythroughs/cornell.json";
    const ProcessResult result = run_tarn({"flythrough", "--path", path, "--size", "64x36", "--frames", "9",
                                           "--measured", "9", "--reference-spp", "256", "--methods",
                                           "ris:samples=16,restir-unbiased", "--out", folder_.file("out")});
    ASSERT_EQ(result.status, 0) << result.err;
    const Json all = results();
    for (const Json& method : all["flythroughs"][0]["methods"]) {
        ASSERT_EQ(method["errors"].size(), 9u);
        for (const Json& error : method["errors"]) {
            EXPECT_NEAR(error["mean_ratio"].get<double>(), 1.0, 0.1) << method["label"] << error.dump();
            EXPECT_LT(error["rel_mse_trimmed"].get<double>(), 0.1) << method["label"] << error.dump();
        }
    }
}

// A scene is flown along a path of its own, never along another scene's.
TEST_F(FlythroughCommand, ASceneFliesItsOwnPathOrAnOrbit) {
    const auto fly_through = [&](const std::string& scene) {
        return run_tarn({"flythrough", scene, "--raw", "--size", "32x18", "--frames", "4", "--measured", "2",
                         "--pictures", "0", "--reference-spp", "16", "--out", folder_.file("out")});
    };
    const ProcessResult own = fly_through("cornell");
    EXPECT_EQ(own.status, 0) << own.err;
    EXPECT_NE(own.out.find("cornell.json"), std::string::npos) << own.out;
    const std::string file = folder_.file("furnace.glb");
    std::filesystem::copy_file(TARN_BUILD_DIR "/content/furnace.glb", file);
    const ProcessResult orbit = fly_through(file);
    EXPECT_EQ(orbit.status, 0) << orbit.err;
    EXPECT_NE(orbit.out.find("an orbit of its bounds"), std::string::npos) << orbit.out;
    EXPECT_EQ(orbit.err.find("nothing but sky"), std::string::npos) << orbit.err;
    std::filesystem::copy_file(TARN_SOURCE_DIR "/content/flythroughs/cornell.json",
                               folder_.file("furnace.flythrough.json"));
    // It moves nodes that the sphere has not: the message shows which path was taken.
    const ProcessResult beside = fly_through(file);
    EXPECT_EQ(beside.status, 1);
    EXPECT_NE(beside.err.find("node"), std::string::npos) << beside.err;
}

// A triangle, and a camera that an animation carries past it.
void write_animated_camera(const std::filesystem::path& file) {
    const float numbers[] = {-1, -1, 0, 1, -1, 0, 0, 1, 0, 0, 1, -0.5f, 0, 3, 0.5f, 0, 3};
    std::ofstream(std::filesystem::path(file).replace_extension(".bin"), std::ios::binary)
        .write(reinterpret_cast<const char*>(numbers), sizeof(numbers));
    std::ofstream(file) << R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0, 1]}],
        "nodes": [{"mesh": 0}, {"camera": 0}],
        "cameras": [{"name": "rider", "type": "perspective", "perspective": {"yfov": 0.8, "znear": 0.1}}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
        "buffers": [{"uri": "ride.bin", "byteLength": 68}],
        "bufferViews": [{"buffer": 0, "byteLength": 36}, {"buffer": 0, "byteOffset": 36, "byteLength": 8},
                        {"buffer": 0, "byteOffset": 44, "byteLength": 24}],
        "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3",
                       "min": [-1, -1, 0], "max": [1, 1, 0]},
                      {"bufferView": 1, "componentType": 5126, "count": 2, "type": "SCALAR", "min": [0], "max": [1]},
                      {"bufferView": 2, "componentType": 5126, "count": 2, "type": "VEC3"}],
        "animations": [{"samplers": [{"input": 1, "output": 2}],
                        "channels": [{"sampler": 0, "target": {"node": 1, "path": "translation"}}]}]})";
}

TEST_F(FlythroughCommand, AnAnimatedCameraIsFollowed) {
    const std::filesystem::path file = folder_.path() / "ride.gltf";
    write_animated_camera(file);
    const ProcessResult result =
        run_tarn({"flythrough", file.string(), "--raw", "--size", "32x18", "--frames", "3", "--measured", "3",
                  "--pictures", "3", "--reference-spp", "2", "--out", folder_.file("out")});
    EXPECT_EQ(result.status, 0) << result.err;
    EXPECT_NE(result.out.find("the way of its camera 'rider'"), std::string::npos) << result.out;
    EXPECT_EQ(result.err.find("nothing but sky"), std::string::npos) << result.err;
    EXPECT_NE(read_text(folder_.path() / "out/frame_0000.png"),
              read_text(folder_.path() / "out/frame_0002.png"));
}

// The camera of the path looks up from above the plane.
TEST_F(FlythroughCommand, APictureWithoutAnythingInItSaysSo) {
    std::ofstream(folder_.file("up.json"))
        << R"({"name": "up", "duration_s": 1, "keys": [)"
        << R"({"time_s": 0, "position": [0, 5, 0], "target": [0, 9, 1], "fov_deg": 30}]})";
    const ProcessResult up = run_tarn({"flythrough", "point_over_plane", "--path", folder_.file("up.json"),
                                       "--raw", "--size", "32x18", "--frames", "2", "--measured", "1",
                                       "--reference-spp", "2", "--out", folder_.file("out")});
    EXPECT_EQ(up.status, 0) << up.err;
    EXPECT_NE(up.err.find("nothing but sky"), std::string::npos) << up.err;
}

TEST_F(FlythroughCommand, AStoppedFlightGoesOnToTheSameFrames) {
    const Arguments arguments = {tarn_program(),    "flythrough", "--methods",  "ris,restir-fast",
                                 "--size",          "64x36",      "--frames",   "120",
                                 "--pictures",      "0",          "--measured", "2",
                                 "--reference-spp", "4",          "--exposure", "0"};
    const auto fly_to = [&](const std::string& out) {
        Arguments all = arguments;
        all.insert(all.end(), {"--out", folder_.file(out)});
        return all;
    };
    {
        Process process(fly_to("broken"));
        ASSERT_TRUE(process.wait_until(
            [&] { return std::filesystem::exists(folder_.path() / "broken/unfinished/frame000040.cbor"); },
            std::chrono::seconds(200)));
        process.send(SIGINT);
        EXPECT_EQ(process.finish().status, 130);
    }
    const auto load = [&](const std::string& out) {
        return Json::parse(read_text(folder_.path() / out / "results.json"))["flythroughs"][0];
    };
    EXPECT_EQ(load("broken")["interrupted"], true);
    ASSERT_EQ(run_process(fly_to("broken")).status, 0);
    ASSERT_EQ(run_process(fly_to("whole")).status, 0);
    const Json broken = load("broken"), whole = load("whole");
    EXPECT_EQ(broken["frames"], 120);
    EXPECT_EQ(broken["interrupted"], false);
    // Without history the same bits; with it, what is left of the past before the stop is nearly gone.
    EXPECT_EQ(broken["methods"][0]["errors"], whole["methods"][0]["errors"]);
    ASSERT_EQ(broken["methods"][1]["errors"].size(), 2u);
}

// What ffmpeg is given: pictures that are there, in the order of the flight, with times that add up to its
// length.
TEST_F(FlythroughCommand, AVideoIsMadeOfThePicturesInTheirOrder) {
    put_first_on_path("ffmpeg", "cp video.txt flythrough.mp4");
    const ProcessResult result = fly(12);
    ASSERT_EQ(result.status, 0) << result.err;
    std::ifstream list(video());
    std::vector<std::string> pictures;
    double duration_s = 0.0;
    for (std::string word; list >> word;) {
        std::string value;
        list >> value;
        if (word == "duration") duration_s += std::stod(value);
        if (word == "file") pictures.push_back(value.substr(1, value.size() - 2));
    }
    ASSERT_EQ(pictures.size(), 12u);
    EXPECT_TRUE(std::is_sorted(pictures.begin(), pictures.end()));
    for (const std::string& picture : pictures)
        EXPECT_TRUE(std::filesystem::exists(folder_.path() / "out" / picture)) << picture;
    EXPECT_NEAR(duration_s, PATH_DURATION_S, 1e-3);
    EXPECT_FALSE(std::filesystem::exists(folder_.path() / "out" / "video.txt"));
}

TEST_F(FlythroughCommand, AVideoThatFailsIsAWarning) {
    put_first_on_path("ffmpeg", "exit 1");
    const ProcessResult result = fly(12);
    EXPECT_EQ(result.status, 0);
    EXPECT_NE(result.err.find("flythrough.mp4: ffmpeg could not make it"), std::string::npos) << result.err;
    EXPECT_EQ(results()["flythroughs"][0]["frames"], 12);
}

TEST_F(FlythroughCommand, FewPicturesAreNoVideo) {
    put_first_on_path("ffmpeg", "cp video.txt flythrough.mp4");
    EXPECT_EQ(fly(2).status, 0);
    EXPECT_FALSE(std::filesystem::exists(video()));
}

// Odd sizes lose a column and a row: the format knows even ones alone.
TEST_F(FlythroughCommand, TheRealFfmpegMakesAVideoAsLongAsThePath) {
    if (run_process({"sh", "-c", "command -v ffmpeg && command -v ffprobe"}).status != 0)
        GTEST_SKIP() << "no ffmpeg here";
    ASSERT_EQ(fly(12).status, 0);
    const auto probe = [&](const std::string& entries) {
        return run_process({"ffprobe", "-loglevel", "error", "-select_streams", "v", "-show_entries",
                            "stream=" + entries, "-of", "csv=p=0", video().string()})
            .out;
    };
    EXPECT_EQ(probe("width,height"), "64,36\n");
    EXPECT_NEAR(std::stod(probe("duration")), PATH_DURATION_S, 0.1);
}

}  // namespace
}  // namespace tarn::test
