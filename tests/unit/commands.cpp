// The command line as a person meets it, as far as it needs no GL: help, wrong usage (status 2), files
// and folders that fail (status 1 and one line), Ctrl-C.
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <fmt/format.h>

#include <csignal>
#include <fstream>
#include <nlohmann/json.hpp>

#include "image_io/image_io.h"
#include "support/process.h"

namespace tarn::test {
namespace {

using Arguments = std::vector<std::string>;

std::string cornell() {
    return TARN_BUILD_DIR "/content/cornell.glb";
}

Arguments operator+(Arguments first, const Arguments& second) {
    first.insert(first.end(), second.begin(), second.end());
    return first;
}

// ---- Help ---------------------------------------------------------------------------------------

const Arguments SCENE_OPTIONS = {"SCENE",  "--size",    "--camera", "--environment",
                                 "--seed", "--threads", "--time",   "--scene"};
const Arguments RENDER_OPTIONS = {"--direct", "--candidates", "--context", "--exposure",      "--preset",
                                  "--raw",    "--tone",       "--glare",   "--glare-strength"};

// The arguments on one line, for messages.
std::string join(const Arguments& arguments) {
    return fmt::format("{} ", fmt::join(arguments, " "));
}

void expect_help(const Arguments& command, const Arguments& words) {
    const ProcessResult result = run_tarn(command + Arguments{"--help"});
    EXPECT_EQ(result.status, 0);
    EXPECT_EQ(result.err, "");
    for (const std::string& word : words) {
        EXPECT_NE(result.out.find(word), std::string::npos)
            << join(command) << "--help does not mention " << word;
    }
}

TEST(Help, NamesTheCommands) {
    expect_help({}, {"info", "render", "reference", "compare", "flythrough", "view"});
}

TEST(Help, NamesEveryOption) {
    expect_help({"info"}, {"SCENE", "--json"});
    expect_help({"render"},
                SCENE_OPTIONS + RENDER_OPTIONS + Arguments{"--out", "--frames", "--accumulate", "--json"});
    expect_help({"reference"}, SCENE_OPTIONS + Arguments{"--out", "--spp", "--relative-error", "--bounces",
                                                         "--direct-only", "--pixel", "--json"});
    expect_help({"compare"}, {"REFERENCE", "IMAGE", "--json", "--difference", "--exposure"});
    expect_help({"flythrough"},
                RENDER_OPTIONS + Arguments{"SCENE", "--path", "--out", "--size", "--frames", "--pictures",
                                           "--measured", "--reference-spp", "--json"});
    expect_help({"view"}, SCENE_OPTIONS + RENDER_OPTIONS);
}

// ---- Wrong usage --------------------------------------------------------------------------------

TEST(WrongUsage, EndsWithStatus2AndSaysWhatIsWrong) {
    const TemporaryFolder folder;
    const Arguments render = {"render", cornell(), "--out", folder.file("a.png"), "--size", "8x8"};
    const Arguments reference = {"reference", cornell(), "--out", folder.file("a.exr"), "--size", "8x8"};
    const Arguments one_sample = reference + Arguments{"--spp", "1"};
    for (const Arguments& arguments : {
             Arguments{},
             Arguments{"bogus"},
             Arguments{"render"},
             Arguments{"render", cornell()},
             render + Arguments{"--bogus"},
             render + Arguments{"--size", "0x5"},
             render + Arguments{"--size", "640"},
             render + Arguments{"--size", "8x8x8"},
             render + Arguments{"--size", "99999x8"},
             render + Arguments{"--seed", "-1"},
             render + Arguments{"--seed", "4294967296"},
             render + Arguments{"--frames", "0"},
             render + Arguments{"--frames", "many"},
             render + Arguments{"--threads", "-1"},
             render + Arguments{"--direct", "best"},
             render + Arguments{"--candidates", "0"},
             render + Arguments{"--candidates", "1e9"},
             render + Arguments{"--candidates", "nan"},
             render + Arguments{"--context", "vulkan"},
             render + Arguments{"--exposure", "bright"},
             render + Arguments{"--tone", "filmic"},
             render + Arguments{"--glare", "some"},
             render + Arguments{"--glare-strength", "nan"},
             render + Arguments{"--exposure", "nan"},
             render + Arguments{"--exposure", "inf"},
             render + Arguments{"--exposure", "41"},
             render + Arguments{"--time", "nan"},
             render + Arguments{"--time", "inf"},
             render + Arguments{"--time-step", "nan"},
             render + Arguments{"--time-step", "-1"},
             render + Arguments{"--sky", "nan"},
             render + Arguments{"--sky", "-1"},
             reference,
             reference + Arguments{"--spp", "0"},
             reference + Arguments{"--relative-error", "-1"},
             reference + Arguments{"--relative-error", "nan"},
             one_sample + Arguments{"--relative-error", "1"},
             one_sample + Arguments{"--bounces", "99"},
             one_sample + Arguments{"--pixel", "corner"},
             Arguments{"reference", cornell(), "--out", folder.file("a.png"), "--spp", "1"},
             Arguments{"flythrough", "--frames", "0"},
             Arguments{"compare", "a.exr"},
             Arguments{"compare", "a.exr", "b.exr", "--exposure", "41"},
             Arguments{"compare", "a.exr", "b.exr", "--exposure", "nan"},
             Arguments{"info"},
         }) {
        const ProcessResult result = run_tarn(arguments);
        EXPECT_EQ(result.status, 2) << join(arguments) << result.err;
        EXPECT_GT(result.error_lines(), 0) << join(arguments);
    }
    EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

// Names of methods and of files' kinds are usage too; one line says what is wrong.
TEST(WrongUsage, OfMethodsAndExtensionsIsOneLine) {
    const TemporaryFolder folder;
    for (const Arguments& arguments : {
             Arguments{"bench", cornell(), "--methods", "no_such_method"},
             Arguments{"bench", cornell(), "--methods", "restir-fast:beauty=1"},
             Arguments{"bench", cornell(), "--methods", "ris,ris"},
             Arguments{"flythrough", "--methods", "no_such_method"},
             Arguments{"study", "lag", "corner", "--methods", "no_such_method"},
             Arguments{"floors", cornell(), "--method", "no_such_method"},
             Arguments{"render", cornell(), "--out", folder.file("a.jpg")},
             Arguments{"render", cornell(), "--out", folder.path().string()},
         }) {
        const ProcessResult result = run_tarn(arguments);
        EXPECT_EQ(result.status, 2) << join(arguments) << result.err;
        EXPECT_EQ(result.error_lines(), 1) << join(arguments) << result.err;
    }
    EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

// ---- Files and folders that fail -------------------------------------------------------------------

// Status 1, and one line on stderr that holds `word`.
void expect_one_line(const Arguments& arguments, const std::string& word) {
    const ProcessResult result = run_tarn(arguments);
    EXPECT_EQ(result.status, 1) << join(arguments);
    EXPECT_EQ(result.error_lines(), 1) << join(arguments) << "\n" << result.err;
    EXPECT_TRUE(result.err.starts_with("tarn: ")) << result.err;
    EXPECT_NE(result.err.find(word), std::string::npos) << join(arguments) << "\n" << result.err;
}

TEST(Disappointment, IsOneLineThatNamesTheFile) {
    const TemporaryFolder folder;
    const std::string picture = folder.file("a.exr");
    for (const std::string command : {"render", "reference"}) {
        const auto with = [&](const std::string& scene, const std::string& out) {
            Arguments arguments = {command, scene, "--out", out, "--size", "8x8"};
            return command == "reference" ? arguments + Arguments{"--spp", "1"} : arguments;
        };
        expect_one_line(with(folder.file("gone.glb"), picture), "gone.glb");
        expect_one_line(with(folder.path().string(), picture), folder.path().string());
        expect_one_line(with("no_such_scene", picture), "no_such_scene");
        expect_one_line(with(cornell(), picture) + Arguments{"--environment", folder.file("gone.hdr")},
                        "gone.hdr");
        expect_one_line(with(cornell(), picture) + Arguments{"--environment", cornell()}, "cornell.glb");
        expect_one_line(with(cornell(), picture) + Arguments{"--scene", "7"}, "scene 7");
    }
    expect_one_line({"info", folder.file("gone.glb")}, "gone.glb");
    expect_one_line({"compare", folder.file("gone.exr"), folder.file("gone.exr")}, "gone.exr");
    expect_one_line({"flythrough", "--path", folder.file("gone.json"), "--out", folder.file("fly")},
                    "gone.json");
    EXPECT_FALSE(std::filesystem::exists(picture));
}

TEST(Disappointment, OfAMistypedNameSaysWhichOnesAreNear) {
    const ProcessResult command = run_tarn({"rendr", "cornell"});
    EXPECT_EQ(command.status, 2);
    EXPECT_NE(command.err.find("tarn: 'rendr' is no command; there are: "), std::string::npos) << command.err;
    EXPECT_NE(command.err.find("; did you mean 'render'?"), std::string::npos) << command.err;
    const ProcessResult method = run_tarn({"bench", "cornell", "--methods", "restir-fats"});
    EXPECT_NE(method.err.find("did you mean 'restir-fast' or 'restir-fine'?"), std::string::npos)
        << method.err;
    expect_one_line({"info", "lantern_cort"}, "did you mean 'lantern_court'?");
    EXPECT_EQ(run_tarn({"info", "no_such_scene"}).err.find("did you mean"), std::string::npos);
}

TEST(Disappointment, OfAnotherFormatSaysHowToConvertIt) {
    const TemporaryFolder folder;
    for (const char* name : {"a.obj", "a.FBX", "a.blend"}) {
        std::ofstream(folder.file(name)) << "v 0 0 0\n";
        expect_one_line({"info", folder.file(name)}, "glTF 2.0");
    }
}

TEST(Disappointment, AFolderThatIsNotThereIsFoundBeforeTheWorkIsDone) {
    const TemporaryFolder folder;
    const std::string gone = folder.file("gone");
    // Each would take minutes to get as far as writing.
    expect_one_line({"render", cornell(), "--out", gone + "/a.png", "--frames", "100000"}, gone);
    expect_one_line({"render", cornell(), "--out", folder.file("a.png"), "--json", gone + "/a.json",
                     "--frames", "100000"},
                    gone);
    expect_one_line({"reference", cornell(), "--out", gone + "/a.exr", "--spp", "1000000"}, gone);
    expect_one_line({"compare", "a.exr", "b.exr", "--json", gone + "/a.json"}, gone);
    expect_one_line({"compare", "a.exr", "b.exr", "--difference", gone + "/a.png"}, gone);
    expect_one_line({"info", cornell(), "--json", gone + "/a.json"}, gone);
    EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

TEST(Disappointment, APipeOrDeviceIsNotReplacedByAFile) {
    const TemporaryFolder folder;
    const std::string pipe = folder.file("pipe");
    ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
    expect_one_line({"info", cornell(), "--json", pipe}, pipe);
    EXPECT_TRUE(std::filesystem::is_fifo(pipe));
}

TEST(Disappointment, ACameraOnANodeWithoutExtentIsNamed) {
    const TemporaryFolder folder;
    const std::string file = folder.file("flat.gltf");
    std::ofstream(file) << R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}],
        "nodes": [{"camera": 0, "scale": [1, 1, 0]}],
        "cameras": [{"name": "flat", "type": "perspective", "perspective": {"yfov": 1, "znear": 0.1}}]})";
    expect_one_line({"reference", file, "--out", folder.file("a.exr"), "--spp", "1", "--size", "8x8"},
                    "camera 0 'flat': axis z");
}

TEST(Disappointment, AnUnknownSceneSaysWhereItWasLookedFor) {
    expect_one_line({"info", "nowhere"}, "share/tarn/content");
    expect_one_line({"info", "nowhere"}, "TARN_CONTENT_DIR");
    const TemporaryFolder folder;
    expect_one_line({"flythrough", "--path", "nowhere", "--out", folder.file("fly")}, "TARN_FLYTHROUGH_DIR");
}

TEST(Disappointment, AnUnknownCameraListsThoseThatExist) {
    const TemporaryFolder folder;
    const Arguments reference = {
        "reference", TARN_BUILD_DIR "/content/lantern_court.glb", "--out", folder.file("a.exr"), "--spp", "1",
        "--camera"};
    for (const char* name : {"'main'", "'arcade'", "'balcony'", "'closeup'"}) {
        expect_one_line(reference + Arguments{"nobody"}, name);
    }
    expect_one_line(reference + Arguments{"4"}, "'4'");
    expect_one_line(reference + Arguments{"0,0,0,1,1,1"}, "0,0,0,1,1,1");
    expect_one_line(reference + Arguments{"0,0,0,1,1,1,180"}, "180 degrees");
}

TEST(Version, IsSaidByTheProgramAndByWhatItWrites) {
    const ProcessResult said = run_tarn({"--version"});
    EXPECT_EQ(said.status, 0);
    for (const char* word : {"tarn 0.", "(commit ", "Embree ", "GLFW "}) {
        EXPECT_NE(said.out.find(word), std::string::npos) << said.out;
    }
    const TemporaryFolder folder;
    const ProcessResult result =
        run_tarn({"reference", cornell(), "--out", folder.file("a.exr"), "--json", folder.file("a.json"),
                  "--size", "8x8", "--spp", "2", "--seed", "3"});
    ASSERT_EQ(result.status, 0) << result.err;
    const nlohmann::json report = nlohmann::json::parse(read_text(folder.file("a.json")));
    const std::string commit = report["tarn"]["commit"];
    EXPECT_NE(said.out.find(commit), std::string::npos);
    const PictureNotes notes = read_exr_notes(folder.file("a.exr"));
    ASSERT_EQ(notes.size(), 2u);
    EXPECT_EQ(notes[0].first, "software");
    EXPECT_EQ(said.out.substr(0, said.out.find('\n')), notes[0].second);
    EXPECT_EQ(notes[1], (std::pair<std::string, std::string>("tarn.run", "seed=3 spp=2")));
}

// ---- Ctrl-C -------------------------------------------------------------------------------------

TEST(Interrupt, TheReferenceWritesWhatItHas) {
    const TemporaryFolder folder;
    Process process({tarn_program(), "reference", cornell(), "--out", folder.file("a.exr"), "--json",
                     folder.file("a.json"), "--size", "64x36", "--spp", "50000000"});
    // Its progress shows that it listens.
    ASSERT_TRUE(process.wait_until([&] { return !process.error_text().empty(); }, std::chrono::seconds(60)));
    process.send(SIGINT);
    const ProcessResult result = process.finish();
    EXPECT_EQ(result.status, 130) << result.err;
    int width = 0, height = 0;
    EXPECT_EQ(read_exr_channels(folder.file("a.exr"), width, height).size(), 6u);
    EXPECT_EQ(width, 64);
    const nlohmann::json report = nlohmann::json::parse(read_text(folder.file("a.json")));
    EXPECT_EQ(report["cancelled"], true);
    EXPECT_GT(report["spp"], 0);
    const auto files = std::filesystem::directory_iterator(folder.path());
    EXPECT_EQ(std::distance(begin(files), end(files)), 2) << "something was left behind";
}

}  // namespace
}  // namespace tarn::test
