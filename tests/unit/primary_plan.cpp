// Raster or rays: who asks decides, else what costs less where the frame is drawn.
#include <gtest/gtest.h>

#include "plan/frame_plan.h"
#include "support/toy_scenes.h"

namespace tarn::test {
namespace {

constexpr std::uint64_t PIXELS = 640 * 360;

bool by_rays(PrimaryVisibility visibility, const FeatureSurvey& survey, const DrawingPlace& place) {
    return plan_primary({visibility}, survey, place).by_rays;
}

FeatureSurvey survey_of(std::uint64_t triangles, bool partly_covered = false) {
    FeatureSurvey survey;
    survey.triangles = triangles;
    survey.partly_covered = partly_covered;
    return survey;
}

TEST(PrimaryPlan, FollowsTheSetting) {
    for (const bool slow_triangles : {false, true}) {
        const DrawingPlace place{PIXELS, slow_triangles};
        EXPECT_FALSE(by_rays(PrimaryVisibility::RASTER, survey_of(100 * PIXELS), place));
        EXPECT_TRUE(by_rays(PrimaryVisibility::RAYS, survey_of(1), place));
    }
}

TEST(PrimaryPlan, DrawsByRaysWhereTheCpuHasManyTrianglesForThePixels) {
    const DrawingPlace cpu{PIXELS, true}, gpu{PIXELS, false};
    EXPECT_FALSE(by_rays(PrimaryVisibility::AUTO, survey_of(PIXELS / 10), cpu));
    EXPECT_TRUE(by_rays(PrimaryVisibility::AUTO, survey_of(PIXELS / 4), cpu));
    EXPECT_FALSE(by_rays(PrimaryVisibility::AUTO, survey_of(PIXELS / 4, true), cpu));
    EXPECT_TRUE(by_rays(PrimaryVisibility::AUTO, survey_of(PIXELS, true), cpu));
    EXPECT_FALSE(by_rays(PrimaryVisibility::AUTO, survey_of(100 * PIXELS), gpu));
}

TEST(PrimaryPlan, CountsTheTrianglesOfAllInstances) {
    ToyScene toy;
    Material leaf;
    leaf.alpha_mode = AlphaMode::MASK;
    const MeshIndex mesh = toy.add_mesh(toy.add_material(Material{}), {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
    for (int i = 0; i < 3; ++i) toy.add_instance(mesh, glm::dmat4(1.0));
    EXPECT_EQ(survey_features(build_world(toy.scene)).triangles, 3u);
    EXPECT_FALSE(survey_features(build_world(toy.scene)).partly_covered);
    toy.add_quad(toy.add_material(leaf), {-1, -1, 0}, {2, 0, 0}, {0, 2, 0});
    EXPECT_EQ(survey_features(build_world(toy.scene)).triangles, 5u);
    EXPECT_TRUE(survey_features(build_world(toy.scene)).partly_covered);
}

}  // namespace
}  // namespace tarn::test
