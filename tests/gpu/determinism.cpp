// The same seed gives the same bits: from EGL, a GLFW window and OSMesa, with one and two threads on both
// sides, frame after frame while the scene moves and deforms; and the same for the reference.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>

#include "image_io/image_io.h"
#include "support/process.h"
#include "support/test_scenes.h"
#include "unit/gltf_builder.h"

namespace tarn::test {
namespace {

struct Case {
    std::string name;
    std::filesystem::path file;
    std::string mode;
    bool moves = true;
};

void PrintTo(const Case& c, std::ostream* out) {
    *out << c.name << " " << c.mode;
}

const std::vector<std::string> THREADS = {"1", "2"};

std::vector<float> read_pixels(const std::string& file) {
    int width = 0, height = 0;
    std::vector<float> pixels;
    for (const ExrChannel& channel : read_exr_channels(file, width, height)) {
        pixels.insert(pixels.end(), channel.values.begin(), channel.values.end());
    }
    return pixels;
}

// Compares bits, so that -0 and 0, or two NaNs, differ.
std::size_t count_different_values(const std::vector<float>& a, const std::vector<float>& b) {
    if (a.size() != b.size()) return std::max(a.size(), b.size());
    std::size_t count = 0;
    for (std::size_t i = 0; i < a.size(); ++i) count += std::memcmp(&a[i], &b[i], sizeof(float)) != 0;
    return count;
}

// Pictures of one kind, by what made them; the first is what all others must equal.
class Pictures {
  public:
    explicit Pictures(std::string name) : name_(std::move(name)) {}

    std::string file(const std::string& maker) const { return folder_.file(maker + ".exr"); }

    void add(const std::string& maker) {
        std::vector<float> pixels = read_pixels(file(maker));
        if (first_.empty()) {
            first_ = std::move(pixels);
            first_maker_ = maker;
            EXPECT_GT(std::count_if(first_.begin(), first_.end(), [](float v) { return v > 0.0f; }),
                      std::ptrdiff_t(first_.size() / 10))
                << name_ << " is nearly black: nothing is compared";
            return;
        }
        EXPECT_EQ(count_different_values(first_, pixels), 0u)
            << name_ << ": values that differ between " << first_maker_ << " and " << maker << ", of "
            << first_.size();
    }

  private:
    std::string name_;
    std::string first_maker_;
    TemporaryFolder folder_;
    std::vector<float> first_;
};

class Determinism : public testing::TestWithParam<Case> {
  protected:
    void SetUp() override {
        if (!std::filesystem::exists(GetParam().file))
            GTEST_SKIP() << GetParam().file.string() << " is not here";
    }

    // `tarn render` of the fourth frame, before which all that can move has moved three times.
    static std::vector<std::string> render_command(const std::string& context, const std::string& threads,
                                                   const std::string& out) {
        std::vector<std::string> command = {tarn_program(), "render", GetParam().file.string(), "--raw"};
        for (const char* word :
             {"--size", "160x90", "--frames", "4", "--seed", "5", "--time", "1.3", "--time-step", "0.2"}) {
            command.emplace_back(word);
        }
        for (const std::string& word :
             {std::string("--direct"), GetParam().mode, std::string("--context"), context,
              std::string("--threads"), threads, std::string("--out"), out}) {
            command.push_back(word);
        }
        return command;
    }

    static void expect_success(const ProcessResult& result) {
        ASSERT_EQ(result.status, 0) << result.out << result.err;
    }
};

TEST_P(Determinism, ContextsAndThreadsGiveTheSameBits) {
    Pictures pictures(GetParam().name + " " + GetParam().mode);
    const std::vector<std::string> with_display = {TARN_WITH_DISPLAY};
    const bool has_display = !with_display.front().empty();
    for (const std::string context : {"egl", "osmesa", "glfw"}) {
        if (context == "glfw" && !has_display) continue;
        for (const std::string& threads : THREADS) {
            const std::string maker = context + "_" + threads + "_threads";
            std::vector<std::string> command = context == "glfw" ? with_display : std::vector<std::string>{};
            for (const std::string& word : render_command(context, threads, pictures.file(maker))) {
                command.push_back(word);
            }
            expect_success(run_process(command));
            if (HasFatalFailure()) return;
            pictures.add(maker);
        }
    }
    if (!has_display) GTEST_SKIP() << "a window was not compared: there is no Xvfb";
}

TEST_P(Determinism, AHeldSceneGivesOtherBitsWhereItMoves) {
    const TemporaryFolder folder;
    std::vector<std::string> command = render_command("egl", "2", folder.file("a.exr"));
    expect_success(run_process(command));
    *std::find(command.begin(), command.end(), "0.2") = "0";
    command.back() = folder.file("b.exr");
    expect_success(run_process(command));
    const std::size_t different =
        count_different_values(read_pixels(folder.file("a.exr")), read_pixels(folder.file("b.exr")));
    EXPECT_EQ(different > 0, GetParam().moves);
}

TEST_P(Determinism, AnotherSeedGivesOtherBits) {
    const TemporaryFolder folder;
    std::vector<std::string> command = render_command("egl", "2", folder.file("a.exr"));
    expect_success(run_process(command));
    *std::find(command.begin(), command.end(), "5") = "6";
    command.back() = folder.file("b.exr");
    expect_success(run_process(command));
    EXPECT_GT(count_different_values(read_pixels(folder.file("a.exr")), read_pixels(folder.file("b.exr"))),
              0u);
}

// A sheet that sways between a lamp and a floor, by a morph target: its BVH is refitted every frame, and so
// are the lamp's triangles, which are part of it.
std::filesystem::path swaying_sheet() {
    constexpr int SIDE = 16;
    std::vector<float> positions, offsets;
    std::vector<std::uint16_t> indices;
    for (int z = 0; z <= SIDE; ++z) {
        for (int x = 0; x <= SIDE; ++x) {
            const float u = float(x) / SIDE, v = float(z) / SIDE;
            positions.insert(positions.end(), {1.6f * u - 0.8f, 1.0f, 1.2f * v - 0.6f});
            offsets.insert(offsets.end(), {0.3f * v, 0.4f * std::sin(6.0f * u), 0.2f * u});
        }
    }
    for (int z = 0; z < SIDE; ++z) {
        for (int x = 0; x < SIDE; ++x) {
            const int a = z * (SIDE + 1) + x, b = a + SIDE + 1;
            for (const int corner : {a, b, b + 1, a, b + 1, a + 1}) indices.push_back(std::uint16_t(corner));
        }
    }
    GltfBuilder gltf;
    const std::size_t count = positions.size() / 3;
    const auto sheet = [&](int material) {
        return nlohmann::json{
            {"attributes", {{"POSITION", gltf.add_floats("VEC3", count, positions)}}},
            {"targets", {{{"POSITION", gltf.add_floats("VEC3", count, offsets)}}}},
            {"indices", gltf.add_accessor("SCALAR", GltfBuilder::UNSIGNED_SHORT, indices.size(), indices)},
            {"material", material}};
    };
    gltf.push("materials", {{"doubleSided", true}});
    gltf.push("materials", {{"emissiveFactor", {1, 0.8, 0.6}}});
    const std::vector<float> floor = {-3, 0, 3, 3, 0, 3, 0, 0, -6};
    gltf.push("meshes", {{"primitives", {sheet(0)}}});
    gltf.push("meshes", {{"primitives", {sheet(1)}}});
    gltf.push("meshes",
              {{"primitives",
                {{{"attributes", {{"POSITION", gltf.add_floats("VEC3", 3, floor)}}}, {"material", 0}}}}});
    gltf.push("cameras", {{"type", "perspective"}, {"perspective", {{"yfov", 0.9}, {"znear", 0.1}}}});
    gltf.push("nodes", {{"mesh", 0}});
    // Upside down, since triangles shine from their front: down onto the sheet and the floor.
    gltf.push("nodes", {{"mesh", 1}, {"translation", {0.4, 3, 0}}, {"rotation", {1, 0, 0, 0}}});
    gltf.push("nodes", {{"mesh", 2}});
    gltf.push("nodes", {{"camera", 0}, {"translation", {0, 1.2, 4}}});
    const int times = gltf.add_floats("SCALAR", 3, {0, 1, 2}),
              weights = gltf.add_floats("SCALAR", 3, {0, 1, 0});
    nlohmann::json channels = nlohmann::json::array();
    for (const int node : {0, 1}) {
        channels.push_back({{"sampler", 0}, {"target", {{"node", node}, {"path", "weights"}}}});
    }
    gltf.push("animations",
              {{"samplers", {{{"input", times}, {"output", weights}}}}, {"channels", channels}});
    static const TemporaryFile file(".gltf", gltf.text());
    return file.path();
}

// Lantern court moves and has leaves with an alpha mask; the blended scene may be absent.
INSTANTIATE_TEST_SUITE_P(
    Scenes, Determinism,
    testing::Values(Case{"cornell", content_file("cornell"), "uniform", false},
                    Case{"cornell", content_file("cornell"), "ris", false},
                    Case{"lantern_court", content_file("lantern_court"), "uniform"},
                    Case{"lantern_court", content_file("lantern_court"), "ris"},
                    Case{"lantern_court", content_file("lantern_court"), "restir"},
                    Case{"swaying_sheet", swaying_sheet(), "ris"},
                    Case{"swaying_sheet", swaying_sheet(), "restir"},
                    Case{"blended", shared_file("AlphaBlendModeTest/AlphaBlendModeTest.glb"), "ris", false}),
    [](const auto& info) { return info.param.name + "_" + info.param.mode; });

TEST(ReferenceDeterminism, ThreadsGiveTheSameBits) {
    for (const std::string scene : {"cornell", "lantern_court"}) {
        Pictures pictures(scene);
        for (const std::string& threads : THREADS) {
            const ProcessResult result = run_tarn({"reference", content_file(scene).string(), "--size",
                                                   "96x54", "--spp", "4", "--seed", "5", "--time", "1.3",
                                                   "--threads", threads, "--out", pictures.file(threads)});
            ASSERT_EQ(result.status, 0) << result.err;
            pictures.add(threads);
        }
    }
}

// Work groups are rows of pixels on the CPU and blocks on a GPU (gl/driver_quirks.h). Wide enough that rows
// are chosen.
TEST(GroupDeterminism, WorkGroupsOfEitherShapeGiveTheSameBits) {
    Pictures pictures("lantern_court, clean");
    for (const std::string shape : {"groups_are_rows", "-groups_are_rows"}) {
        const ProcessResult result =
            run_process({"env", "TARN_QUIRKS=timestamps_at_submission," + shape, tarn_program(), "render",
                         content_file("lantern_court").string(), "--size", "300x70", "--frames", "3",
                         "--time", "1.3", "--time-step", "0.2", "--out", pictures.file(shape)});
        ASSERT_EQ(result.status, 0) << result.err;
        pictures.add(shape);
    }
}

// What a frame adds to a cache must not depend on the order of threads.
TEST(CacheDeterminism, ThreadsGiveTheSameBits) {
    for (const std::string cache : {"screen", "world"}) {
        Pictures pictures("lantern_court, cache " + cache);
        for (const std::string& threads : THREADS) {
            const ProcessResult result =
                run_tarn({"render", content_file("lantern_court").string(), "--raw", "--size", "96x54",
                          "--frames", "6", "--seed", "5", "--indirect", "restir", "--indirect-cache", cache,
                          "--threads", threads, "--out", pictures.file(threads)});
            ASSERT_EQ(result.status, 0) << result.err;
            pictures.add(threads);
        }
    }
}

}  // namespace
}  // namespace tarn::test
