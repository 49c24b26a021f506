// Every shader under shaders/passes compiles and links in every variant that a plan can ask for, without a
// complaint of the driver.
#include <gtest/gtest.h>

#include <set>

#include "gl/program_library.h"
#include "passes/display.h"
#include "support/on_context.h"

namespace tarn {
namespace {

using Defines = std::vector<std::string>;

Defines operator+(Defines first, const Defines& second) {
    first.insert(first.end(), second.begin(), second.end());
    return first;
}

// What a scene can have (plan/frame_plan.cpp). Some of it implies more: a normal map is a texture, and a
// textured light is a triangle with a texture.
std::vector<Defines> list_scene_variants() {
    std::vector<Defines> result;
    for (const Defines& textures :
         {Defines{}, Defines{"TARN_TEXTURES"}, Defines{"TARN_TEXTURES", "TARN_NORMAL_MAPS"}}) {
        std::vector<Defines> triangles = {{}, {"TARN_TRIANGLE_LIGHTS"}};
        if (!textures.empty()) triangles.push_back({"TARN_TRIANGLE_LIGHTS", "TARN_TEXTURED_LIGHTS"});
        for (const Defines& environment : {Defines{}, Defines{"TARN_ENVIRONMENT"}}) {
            for (const Defines& punctual : {Defines{}, Defines{"TARN_PUNCTUAL_LIGHTS"}}) {
                for (const Defines& triangle : triangles)
                    result.push_back(textures + environment + punctual + triangle);
                // The rest stands alone: it changes what the others have in common.
                result.push_back(textures + environment + punctual + Defines{"TARN_LAMBERT_ONLY"});
                result.push_back(textures + environment + punctual +
                                 Defines{"TARN_TRIANGLE_LIGHTS", "TARN_COVERED_LIGHTS"});
            }
        }
    }
    return result;
}

// "direct/shade" for each entry shader; a vertex shader and its fragment shader count once.
std::set<std::string> list_passes() {
    const std::filesystem::path folder = get_shader_root() / "passes";
    std::set<std::string> result;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
        if (entry.is_regular_file()) {
            result.insert(
                std::filesystem::relative(entry.path(), folder).replace_extension().generic_string());
        }
    }
    return result;
}

bool is_graphics(const std::string& pass) {
    return std::filesystem::exists(get_shader_root() / "passes" / (pass + ".vert"));
}

bool is_reuse(const std::string& pass) {
    return pass == "direct/temporal" || pass == "direct/spatial";
}

// Every mode of reuse, in both of its runs, as first and as last step.
std::vector<Defines> list_reuse_modes() {
    std::vector<Defines> result;
    for (const char* mis : {"TARN_MIS=0", "TARN_MIS=1", "TARN_MIS=2", "TARN_MIS=3"}) {
        for (const char* mis_visibility : {"TARN_MIS_VISIBILITY=0", "TARN_MIS_VISIBILITY=1"}) {
            for (const char* visibility :
                 {"TARN_SAMPLE_VISIBILITY=0", "TARN_SAMPLE_VISIBILITY=1", "TARN_SAMPLE_VISIBILITY=2"}) {
                for (const Defines& run : {Defines{}, Defines{"TARN_LAST_STEP"}, Defines{"TARN_SHADE_ALL"},
                                           Defines{"TARN_WRITE_RAYS"}}) {
                    result.push_back(Defines{mis, mis_visibility, visibility} + run);
                }
            }
        }
    }
    return result;
}

// Variants of one pass besides what the scene has.
std::vector<Defines> list_own_variants(const std::string& pass) {
    if (pass == "direct/candidates")
        return {{"TARN_SELECT_UNIFORM"},
                {"TARN_SELECT_POWER"},
                {"TARN_SELECT_TILES", "TARN_BRDF_CANDIDATE"},
                {"TARN_SELECT_TREE"}};
    if (pass == "direct/shade")
        return {{},
                {"TARN_RESERVOIR_VISIBILITY", "TARN_ONE_CHANNEL", "TARN_ADD"},
                {"TARN_SHOW_VISIBILITY"},
                {"TARN_SHOW_UNSHADOWED"},
                {"TARN_SHADED"}};
    if (is_reuse(pass)) return {{"TARN_MIS=2", "TARN_MIS_VISIBILITY=1", "TARN_SAMPLE_VISIBILITY=0"}};
    if (pass == "gbuffer/raster") return {{}, {"TARN_COVERAGE"}};
    return {{}};
}

class ShaderVariants : public test::OnDebugContext<testing::TestWithParam<std::string>> {
  protected:
    void SetUp() override { take_debug_errors(); }

    void compile(const Defines& defines) {
        const std::string& pass = GetParam();
        is_graphics(pass) ? programs_.graphics(pass, defines) : programs_.compute(pass, defines);
        const std::vector<std::string> complaints = take_debug_errors();
        std::string variant = pass;
        for (const std::string& define : defines) variant += " " + define;
        EXPECT_TRUE(complaints.empty()) << variant << ": " << complaints.front();
    }

    ProgramLibrary programs_;
};

TEST_P(ShaderVariants, AllCompile) {
    if (GetParam() == "display") {
        for (const DisplayViewInfo& view : display_views()) compile({view.define});
        EXPECT_EQ(programs_.program_count(), display_views().size());
        return;
    }
    for (const Defines& own : list_own_variants(GetParam())) {
        for (const Defines& scene : list_scene_variants()) compile(scene + own);
    }
    EXPECT_EQ(programs_.program_count(), list_own_variants(GetParam()).size() * list_scene_variants().size());
    // What tests plant must compile too, or they would find the wrong fault.
    for (const char* bug : {"TARN_PLANT_DROP_PDF", "TARN_PLANT_DROP_COSINE", "TARN_PLANT_SHIFT_LIGHT",
                            "TARN_PLANT_SKIP_CONFIDENCE", "TARN_PLANT_COUNT_DEAD",
                            "TARN_PLANT_TARGET_AT_NEIGHBOUR", "TARN_PLANT_DROP_NORMALIZATION",
                            "TARN_PLANT_PREVIOUS_NORMAL", "TARN_PLANT_FORGET_LIGHT_PDF", "TARN_CHECK_MIS"}) {
        compile(Defines{"TARN_TRIANGLE_LIGHTS", bug} + list_own_variants(GetParam()).front());
    }
}

// The modes of reuse over a scene that has and does everything.
class ReuseVariants : public ShaderVariants {};

TEST_P(ReuseVariants, AllModesCompile) {
    const Defines scene = {"TARN_TEXTURES",        "TARN_NORMAL_MAPS",     "TARN_ENVIRONMENT",
                           "TARN_PUNCTUAL_LIGHTS", "TARN_TRIANGLE_LIGHTS", "TARN_COVERED_LIGHTS",
                           "TARN_TEXTURED_LIGHTS", "TARN_MOTION",          "TARN_LIGHT_HISTORY"};
    for (const Defines& mode : list_reuse_modes()) compile(scene + mode);
}

INSTANTIATE_TEST_SUITE_P(Passes, ReuseVariants, testing::Values("direct/temporal", "direct/spatial"),
                         [](const auto& info) {
                             return info.param == "direct/temporal" ? "temporal" : "spatial";
                         });

INSTANTIATE_TEST_SUITE_P(Passes, ShaderVariants, testing::ValuesIn(list_passes()), [](const auto& info) {
    std::string name = info.param;
    std::replace(name.begin(), name.end(), '/', '_');
    return name;
});

TEST(ShaderVariantList, NamesEveryPassOfTheFolder) {
    const std::set<std::string> passes = list_passes();
    for (const char* known : {"direct/candidates", "direct/temporal", "direct/spatial", "direct/shade",
                              "display", "gbuffer/raster", "gbuffer/resolve"}) {
        EXPECT_TRUE(passes.contains(known)) << known;
    }
}

}  // namespace
}  // namespace tarn
