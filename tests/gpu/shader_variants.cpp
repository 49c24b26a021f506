// Every shader under shaders/passes compiles in every variant that a plan can ask for, and each of its
// choices links once where the scene has most to bind, without a complaint of the driver.
//
// Linking takes six times as long as compiling, and of a compute shader, whose functions all have bodies, it
// can but find that it asks for more than there is.
#include <gtest/gtest.h>

#include <set>

#include "gl/program_library.h"
#include "plan/shader_variants.h"
#include "support/on_context.h"

namespace tarn {
namespace {

Defines operator+(Defines first, const Defines& second) {
    first.insert(first.end(), second.begin(), second.end());
    return first;
}

// "direct/shade" for each entry shader of the folder; a vertex shader and its fragment shader count once.
std::set<std::string> list_files() {
    const std::filesystem::path folder = get_shader_root() / "passes";
    std::set<std::string> result;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
        const bool is_hidden = entry.path().filename().string().starts_with(".");  // .clang-format
        if (entry.is_regular_file() && !is_hidden) {
            result.insert(
                std::filesystem::relative(entry.path(), folder).replace_extension().generic_string());
        }
    }
    return result;
}

bool is_graphics(const std::string& pass) {
    return std::filesystem::exists(get_shader_root() / "passes" / (pass + ".vert"));
}

class ShaderVariants : public test::OnDebugContext<testing::TestWithParam<ShaderFamily>> {
  protected:
    void SetUp() override { take_debug_errors(); }

    void link(const Defines& defines) {
        const std::string& pass = GetParam().path;
        is_graphics(pass) ? programs_.graphics(pass, defines) : programs_.compute(pass, defines);
        expect_no_complaint(defines);
    }

    void compile(const Defines& defines) {
        const std::string& pass = GetParam().path;
        if (is_graphics(pass)) return link(defines);  // two shaders, which must fit together
        const ShaderSource source =
            load_shader_source(get_shader_root(), "passes/" + pass + ".comp", defines);
        check_shader(describe(defines), {GL_COMPUTE_SHADER, source});
        expect_no_complaint(defines);
    }

    void expect_no_complaint(const Defines& defines) {
        const std::vector<std::string> complaints = take_debug_errors();
        if (complaints.empty()) return;
        ADD_FAILURE() << describe(defines) << ": " << complaints.front();
    }

    static std::string describe(const Defines& defines) {
        return fmt::format("{} [{}]", GetParam().path, fmt::join(defines, " "));
    }

    ProgramLibrary programs_;
};

// Whether a variant has a define that none before it had; `seen` are theirs.
bool brings_news(const Defines& defines, std::set<std::string>& seen) {
    bool news = seen.empty();
    for (const std::string& define : defines) news = seen.insert(define).second || news;
    seen.insert("");
    return news;
}

// Each of its own variants with the least and the most that a scene can have, and its first one with every
// scene. Those that bring a define are linked with the most, and the first with the least as well.
TEST_P(ShaderVariants, AllCompile) {
    std::vector<SceneFeatures> scenes = {SceneFeatures{}};
    if (GetParam().is_of_scene) scenes = SceneFeatures::all();
    std::set<std::string> seen;
    for (const Defines& own : GetParam().variants) {
        compile(scenes.front().defines() + own);
        const Defines most = scenes.back().defines() + own;
        brings_news(own, seen) ? link(most) : compile(most);
    }
    link(scenes.front().defines() + GetParam().variants.front());
    for (const SceneFeatures& scene : scenes) compile(scene.defines() + GetParam().variants.front());
}

// What tests plant must compile too, or they would find the wrong fault.
TEST_P(ShaderVariants, PlantedBugsCompile) {
    if (!GetParam().is_of_scene) return;
    for (const char* bug : {"TARN_PLANT_DROP_PDF",
                            "TARN_PLANT_DROP_COSINE",
                            "TARN_PLANT_SHIFT_LIGHT",
                            "TARN_PLANT_SKIP_CONFIDENCE",
                            "TARN_PLANT_COUNT_DEAD",
                            "TARN_PLANT_TARGET_AT_NEIGHBOUR",
                            "TARN_PLANT_DROP_NORMALIZATION",
                            "TARN_PLANT_PREVIOUS_NORMAL",
                            "TARN_PLANT_FORGET_LIGHT_PDF",
                            "TARN_PLANT_DROP_PREVIOUS_JACOBIAN",
                            "TARN_PLANT_DROP_FRESH_JACOBIAN",
                            "TARN_PLANT_PRESENT_GEOMETRY",
                            "TARN_PLANT_NO_REMAP",
                            "TARN_PLANT_NAN_HISTORY",
                            "TARN_PLANT_DROP_RECONNECTION_JACOBIAN",
                            "TARN_PLANT_CLAMP_RECONNECTION_JACOBIAN",
                            "TARN_PLANT_COUNT_EMISSION",
                            "TARN_PLANT_STALE_LIGHT",
                            "TARN_PLANT_FORGET_SKY_SHARE_OF_PATHS",
                            "TARN_PLANT_FORGET_OFFSET",
                            "TARN_PLANT_PRESENT_OFFSET",
                            "TARN_PLANT_DROP_UPSAMPLE_NORMALIZATION",
                            "TARN_PLANT_NO_GEOMETRY_TEST",
                            "TARN_PLANT_DROP_FILTER_NORMALIZATION",
                            "TARN_PLANT_DROP_VARIANCE",
                            "TARN_PLANT_UNSANITIZED",
                            "TARN_PLANT_IGNORE_CHANGES",
                            "TARN_CHECK_MIS"}) {
        compile(SceneFeatures::all().back().defines() + Defines{bug} + GetParam().variants.front());
    }
}

INSTANTIATE_TEST_SUITE_P(Passes, ShaderVariants, testing::ValuesIn(shader_families()), [](const auto& info) {
    std::string name = info.param.path;
    std::replace(name.begin(), name.end(), '/', '_');
    return name;
});

// A shader that the table leaves out is one that no test compiles.
TEST(ShaderFamilies, NameEveryShaderOfTheFolder) {
    std::set<std::string> listed;
    for (const ShaderFamily& family : shader_families()) listed.insert(family.path);
    EXPECT_EQ(listed, list_files());
}

}  // namespace
}  // namespace tarn
