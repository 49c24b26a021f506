// The same seed gives the same bits: from EGL, a GLFW window and OSMesa, with one and two threads on both
// sides, frame after frame; and the same for the reference.
#include <gtest/gtest.h>

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <map>

#include "image_io/image_io.h"
#include "support/process.h"
#include "support/test_scenes.h"

namespace tarn::test {
namespace {

struct Case {
    std::string name;
    std::filesystem::path file;
    std::string mode;
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

    // `tarn render` of the third frame, at a moment when what can move has moved.
    static std::vector<std::string> render_command(const std::string& context, const std::string& threads,
                                                   const std::string& out) {
        std::vector<std::string> command = {tarn_program(), "render", GetParam().file.string()};
        for (const char* word : {"--size", "160x90", "--frames", "3", "--seed", "5", "--time", "1.3"}) {
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

// Whether a context of this kind starts here; says why not.
bool can_start(const std::vector<std::string>& wrapper, const std::string& context, std::string& reason) {
    const TemporaryFolder folder;
    std::vector<std::string> command = wrapper;
    for (const std::string& word :
         {tarn_program(), std::string("render"), content_file("point_over_plane").string(),
          std::string("--size"), std::string("8x8"), std::string("--context"), context, std::string("--out"),
          folder.file("probe.exr")}) {
        command.push_back(word);
    }
    const ProcessResult result = run_process(command);
    if (result.status != 0) reason += fmt::format("{}: status {} {} ", context, result.status, result.err);
    return result.status == 0;
}

TEST_P(Determinism, ContextsAndThreadsGiveTheSameBits) {
    Pictures pictures(GetParam().name + " " + GetParam().mode);
    std::string missing;
    const std::vector<std::string> xvfb = {TARN_XVFB_RUN, "-a"};
    for (const std::string context : {"egl", "osmesa", "glfw"}) {
        const std::vector<std::string> wrapper = context == "glfw" ? xvfb : std::vector<std::string>{};
        if (context == "glfw" && std::string(TARN_XVFB_RUN).empty()) {
            missing += "glfw: there is no xvfb-run ";
            continue;
        }
        if (!can_start(wrapper, context, missing)) continue;
        for (const std::string& threads : THREADS) {
            const std::string maker = context + "_" + threads + "_threads";
            std::vector<std::string> command = wrapper;
            for (const std::string& word : render_command(context, threads, pictures.file(maker))) {
                command.push_back(word);
            }
            expect_success(run_process(command));
            if (HasFatalFailure()) return;
            pictures.add(maker);
        }
    }
    if (!missing.empty()) GTEST_SKIP() << "not compared: " << missing;
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

// Lantern court moves and has leaves with an alpha mask; the blended scene may be absent.
INSTANTIATE_TEST_SUITE_P(
    Scenes, Determinism,
    testing::Values(Case{"cornell", content_file("cornell"), "uniform"},
                    Case{"cornell", content_file("cornell"), "ris"},
                    Case{"lantern_court", content_file("lantern_court"), "uniform"},
                    Case{"lantern_court", content_file("lantern_court"), "ris"},
                    Case{"blended", shared_file("AlphaBlendModeTest/AlphaBlendModeTest.glb"), "ris"}),
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

}  // namespace
}  // namespace tarn::test
