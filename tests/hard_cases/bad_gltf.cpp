// `tarn info` over broken glTF files, each in a process of its own: it loads, or it says one line and exits
// with 1.
#include <fcntl.h>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <sstream>
#include <thread>

#include "unit/gltf_builder.h"

namespace tarn {
namespace {

constexpr auto TIME_LIMIT = std::chrono::seconds(10);

const std::filesystem::path TARN = std::filesystem::path(TARN_BUILD_DIR) / "tarn";
const std::filesystem::path CORPUS = std::filesystem::path(TARN_SHARED_DIR) / "badgltf";

struct Outcome {
    int exit_status = -1;  // -1: killed by a signal, or by us after TIME_LIMIT
    std::string error_text;
    long peak_kib = 0;

    bool loaded() const { return exit_status == 0; }
};

std::string read_text(const std::filesystem::path& path) {
    std::ifstream file(path, std::ios::binary);
    std::ostringstream text;
    text << file.rdbuf();
    return text.str();
}

// `info` imports the scene alone; `reference` also flattens it, builds its BVHs and traces a few rays.
[[noreturn]] void become_tarn(const std::string& command, const std::filesystem::path& scene,
                              const std::filesystem::path& error_file) {
    const int null_device = open("/dev/null", O_WRONLY);
    const int errors = open(error_file.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
    dup2(null_device, STDOUT_FILENO);
    dup2(errors, STDERR_FILENO);
    if (command == "info")
        execl(TARN.c_str(), TARN.c_str(), "info", scene.c_str(), static_cast<char*>(nullptr));
    const std::string picture = error_file.string() + ".exr";
    execl(TARN.c_str(), TARN.c_str(), "reference", scene.c_str(), "--spp", "1", "--size", "8x8", "--out",
          picture.c_str(), static_cast<char*>(nullptr));
    _exit(127);
}

// Waits for the child, for TIME_LIMIT at most.
Outcome wait_for(pid_t child) {
    const auto deadline = std::chrono::steady_clock::now() + TIME_LIMIT;
    Outcome outcome;
    int status = 0;
    rusage usage{};
    while (wait4(child, &status, WNOHANG, &usage) == 0) {
        if (std::chrono::steady_clock::now() > deadline) {
            kill(child, SIGKILL);
            wait4(child, &status, 0, &usage);
            outcome.error_text = "no end after 10 s";
            return outcome;
        }
        std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
    if (WIFEXITED(status)) outcome.exit_status = WEXITSTATUS(status);
    outcome.peak_kib = usage.ru_maxrss;
    return outcome;
}

Outcome run_tarn(const std::string& command, const std::filesystem::path& scene) {
    const TemporaryFile error_file(".txt", "");
    const pid_t child = fork();
    if (child == 0) become_tarn(command, scene, error_file.path());
    Outcome outcome = wait_for(child);
    std::filesystem::remove(error_file.path().string() + ".exr");
    outcome.error_text += read_text(error_file.path());
    return outcome;
}

// What is wrong with how the program ended; empty where nothing is. Warnings may stand beside a success
// alone.
std::string complaint_about(const Outcome& outcome, const std::filesystem::path& scene) {
    if (outcome.error_text.find("Sanitizer") != std::string::npos) return "a sanitizer speaks";
    if (outcome.loaded()) return "";
    if (outcome.exit_status != 1) return fmt::format("exit status {}", outcome.exit_status);
    const auto lines = std::count(outcome.error_text.begin(), outcome.error_text.end(), '\n');
    if (lines != 1 || outcome.error_text.back() != '\n')
        return fmt::format("{} lines of error instead of one", lines);
    if (outcome.error_text.find(scene.filename().string()) == std::string::npos)
        return "the file is not named";
    return "";
}

struct Entry {
    std::string file;
    std::string kind;  // valid, warnings, invalid, unparsable
};

std::vector<Entry> read_expectations() {
    std::vector<Entry> entries;
    std::ifstream table(CORPUS / "EXPECTED.tsv");
    std::string line;
    std::getline(table, line);
    while (std::getline(table, line)) {
        std::istringstream fields(line);
        Entry entry;
        std::getline(fields, entry.file, '\t');
        std::getline(fields, entry.kind, '\t');
        if (!entry.file.empty()) entries.push_back(entry);
    }
    return entries;
}

TEST(BadGltf, CorpusLoadsOrIsRefusedWithOneLine) {
    if (!std::filesystem::exists(CORPUS / "EXPECTED.tsv")) GTEST_SKIP() << CORPUS << " is not there";
    ASSERT_TRUE(std::filesystem::exists(TARN)) << TARN << " is not built";
    const std::vector<Entry> entries = read_expectations();
    ASSERT_EQ(entries.size(), 280u);
    std::size_t as_described = 0;
    std::size_t loaded = 0;
    for (const Entry& entry : entries) {
        const std::filesystem::path scene = CORPUS / entry.file;
        const Outcome outcome = run_tarn("info", scene);
        std::string complaint = complaint_about(outcome, scene);
        if (complaint.empty() && outcome.loaded())
            complaint = complaint_about(run_tarn("reference", scene), scene);
        const bool names_extension = outcome.error_text.find(": requires ") != std::string::npos &&
                                     outcome.error_text.find("not supported") != std::string::npos;
        if (complaint.empty() && entry.kind == "valid" && !outcome.loaded() && !names_extension) {
            complaint = "a valid file is refused";
        }
        EXPECT_EQ(complaint, "") << entry.file << ": " << outcome.error_text;
        as_described += complaint.empty() ? 1 : 0;
        loaded += outcome.loaded() ? 1 : 0;
    }
    fmt::print("{} of {} as described: {} loaded, {} rejected with one line\n", as_described, entries.size(),
               loaded, entries.size() - loaded);
}

// Runs the program over one self-made file and expects it to be refused for the given reason, in little
// memory.
void expect_refusal(const std::string& suffix, const std::string& content, const std::string& reason) {
    ASSERT_TRUE(std::filesystem::exists(TARN)) << TARN << " is not built";
    const TemporaryFile file(suffix, content);
    const Outcome outcome = run_tarn("info", file.path());
    EXPECT_EQ(outcome.exit_status, 1) << outcome.error_text;
    EXPECT_EQ(complaint_about(outcome, file.path()), "") << outcome.error_text;
    EXPECT_NE(outcome.error_text.find(reason), std::string::npos) << outcome.error_text;
    EXPECT_LT(outcome.peak_kib, 1 << 20) << "KiB at the peak";
}

GltfBuilder one_triangle() {
    GltfBuilder gltf;
    gltf.show({{"attributes", {{"POSITION", gltf.add_triangle_positions()}}}});
    return gltf;
}

TEST(BadGltf, TheControlLoads) {
    ASSERT_TRUE(std::filesystem::exists(TARN)) << TARN << " is not built";
    const TemporaryFile file(".gltf", one_triangle().text());
    EXPECT_TRUE(run_tarn("info", file.path()).loaded());
}

TEST(BadGltf, IndexOutOfRange) {
    GltfBuilder gltf = one_triangle();
    const int indices =
        gltf.add_accessor<std::uint16_t>("SCALAR", GltfBuilder::UNSIGNED_SHORT, 3, {0, 1, 40000});
    gltf.json["meshes"][0]["primitives"][0]["indices"] = indices;
    expect_refusal(".gltf", gltf.text(), "is 40000, the primitive has 3 vertices");
}

TEST(BadGltf, PositionThatIsNotANumber) {
    GltfBuilder gltf;
    gltf.show({{"attributes", {{"POSITION", gltf.add_floats("VEC3", 3, {0, 0, 0, NAN, 0, 0, 0, 1, 0})}}}});
    expect_refusal(".gltf", gltf.text(), "accessors[0] element 1 component 0 is nan");
}

TEST(BadGltf, NodeCycle) {
    GltfBuilder gltf = one_triangle();
    gltf.json["nodes"][0]["children"] = {1};
    gltf.push("nodes", {{"children", {0}}});
    expect_refusal(".gltf", gltf.text(), "nodes[0] is its own ancestor");
}

TEST(BadGltf, ClaimOfFourGigabytes) {
    GltfBuilder gltf = one_triangle();
    gltf.json["accessors"][0]["count"] = 357913941;
    expect_refusal(".gltf", gltf.text(), "accessors[0] reads 357913941 elements");
    gltf.json["accessors"][0].erase("bufferView");
    expect_refusal(".gltf", gltf.text(), "accessors[0] claims 357913941 elements without data");
    nlohmann::json json = nlohmann::json::parse(one_triangle().text());
    json["buffers"][0]["byteLength"] = 4294967295u;
    expect_refusal(".gltf", json.dump(), "buffers[0].byteLength is 4294967295, its data has 36 bytes");
}

TEST(BadGltf, PictureThatLiesAboutItsSize) {
    // A PNG header of 16000 x 16000 pixels, RGBA, and nothing behind it.
    const std::vector<std::uint8_t> png = {0x89, 'P',  'N', 'G', '\r', '\n', 0x1a, '\n', 0,    0, 0,
                                           13,   'I',  'H', 'D', 'R',  0,    0,    0x3e, 0x80, 0, 0,
                                           0x3e, 0x80, 8,   6,   0,    0,    0,    0,    0,    0, 0};
    GltfBuilder gltf = one_triangle();
    gltf.push("images", {{"uri", "data:image/png;base64," + GltfBuilder::base64(png)}});
    gltf.push("textures", {{"source", 0}});
    gltf.push("materials", {{"emissiveTexture", {{"index", 0}}}});
    gltf.json["meshes"][0]["primitives"][0]["material"] = 0;
    expect_refusal(".gltf", gltf.text(), "images[0] claims 16000x16000 pixels, which 33 bytes cannot hold");
}

TEST(BadGltf, JsonNestedDeep) {
    const std::string deep(1000000, '[');
    expect_refusal(".gltf", deep, "JSON is nested deeper than 128 levels");
    expect_refusal(".gltf", R"({"asset":{"version":"2.0"},"extras":)" + deep + "}", "nested deeper");
}

TEST(BadGltf, TruncatedBinary) {
    expect_refusal(".glb", std::string("glTF\2\0\0\0", 8), "GLB header is cut off after 8 bytes");
    expect_refusal(".glb", std::string("glTF\2\0\0\0\xff\xff\xff\xff", 12),
                   "GLB header claims 4294967295 bytes");
    expect_refusal(".glb", std::string("glTF\2\0\0\0\x18\0\0\0\xff\xff\xff\x7fJSON{}  ", 24),
                   "claims 2147483647 bytes");
}

TEST(BadGltf, EmptyAndForeignFiles) {
    expect_refusal(".gltf", "", "JSON");
    expect_refusal(".gltf", "{}", "asset is missing");
    expect_refusal(".gltf", "\x89PNG\r\n", "JSON");
}

}  // namespace
}  // namespace tarn
