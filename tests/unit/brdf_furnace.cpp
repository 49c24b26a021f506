// Energy of the BRDF in a white furnace: nothing reflects more than arrives, and white surfaces reflect no
// less.
#include <gtest/gtest.h>

#include "support/brdf_cases.h"
#include "support/draws.h"

namespace tarn {
namespace {

using namespace test;

// The glTF mix of dielectric and metal, base colour white.
SurfaceMaterial white_material(double f0, double specular_weight, double metallic, double alpha) {
    return make_material(1.0 - metallic, glm::mix(f0 * specular_weight, 1.0, metallic),
                         glm::mix(specular_weight, 1.0, metallic), alpha);
}

// Share of the light from `view` that leaves again, in a uniform sky.
double directional_albedo(const Brdf& brdf, const SurfaceMaterial& m, const dvec3& view,
                          int point_count = 20'000) {
    return test::integrate_hemisphere([&](const dvec3& l) { return brdf(m, vec3(view), vec3(l)) * l.z; },
                                      view, m.alpha, point_count);
}

TEST(BrdfFurnace, WhiteLambertReflectsAllLight) {
    for (const double angle : VIEW_ANGLES_DEG) {
        EXPECT_NEAR(directional_albedo(shipped_brdf, make_material(1.0, 0.0, 0.0, 0.5), view_at(angle)), 1.0,
                    1e-3);
    }
}

// A narrow layer's second lobe changes fast at grazing angles, where few points of the lattice lie.
int choose_point_count(double alpha) {
    return alpha < 0.1 ? 20'000 : 4000;
}

// ---- White surfaces
// -------------------------------------------------------------------------------------------------------

constexpr double MOST = 1.0 + 1e-3;
constexpr double LEAST = 1.0 - 1e-2;

// The least and the greatest share over `steps` roughnesses and angles up to 85 degrees.
glm::dvec2 find_extremes(const Brdf& brdf, double albedo, double f0, int steps, int point_count) {
    glm::dvec2 extremes(INFINITY, -INFINITY);
    for (int i = 0; i <= steps; ++i) {
        const double roughness = double(i) / steps;
        const SurfaceMaterial m =
            make_material(albedo, f0, 1.0, std::max(roughness * roughness, double(MIN_ALPHA)));
        for (const double angle : {0.0, 15.0, 30.0, 45.0, 60.0, 70.0, 75.0, 80.0, 85.0}) {
            const double share = directional_albedo(brdf, m, view_at(angle), point_count);
            extremes = {std::min(extremes.x, share), std::max(extremes.y, share)};
        }
    }
    return extremes;
}

bool is_white(const glm::dvec2& extremes) {
    return extremes.x >= LEAST && extremes.y <= MOST;
}

TEST(BrdfFurnace, AWhiteDielectricReflectsAllLightAtEachRoughness) {
    const glm::dvec2 extremes = find_extremes(shipped_brdf, 1.0, 0.04, 20, 20'000);
    std::printf("white dielectric: %.4f to %.4f\n", extremes.x, extremes.y);
    EXPECT_TRUE(is_white(extremes)) << extremes.x << " to " << extremes.y;
}

TEST(BrdfFurnace, AWhiteMetalReflectsAllLightAtEachRoughness) {
    const glm::dvec2 extremes = find_extremes(shipped_brdf, 0.0, 1.0, 20, 20'000);
    std::printf("white metal: %.4f to %.4f\n", extremes.x, extremes.y);
    EXPECT_TRUE(is_white(extremes)) << extremes.x << " to " << extremes.y;
}

// Between metal and dielectric white surfaces are as white.
TEST(BrdfFurnace, AWhiteMixOfMetalAndDielectricReflectsAllLight) {
    for (const double metallic : {0.1, 0.5, 0.9}) {
        for (const double alpha : {0.01, 0.1, 0.5, 1.0}) {
            const SurfaceMaterial mixed =
                mix_material(vec3(1.0f), float(metallic), vec3(0.04f), 1.0f, float(alpha));
            SurfaceMaterial sample_formula = mixed;
            sample_formula.diffuse_albedo = vec3(float(1.0 - metallic));
            for (const double angle : {0.0, 45.0, 80.0}) {
                const double share = directional_albedo(shipped_brdf, mixed, view_at(angle));
                EXPECT_GE(share, LEAST) << metallic << ", alpha " << alpha << ", " << angle << " degrees";
                EXPECT_LE(share, MOST) << metallic << ", alpha " << alpha << ", " << angle << " degrees";
                // The base under the mixed layer: what the sample formula of glTF's appendix B does.
                if (metallic == 0.5 && angle == 0.0 && alpha == 0.1) {
                    EXPECT_LT(directional_albedo(shipped_brdf, sample_formula, view_at(angle)), 0.8);
                }
            }
        }
    }
}

// A grey mix is the mix of the two BRDFs, to within what its layer's coupling to the base changes.
TEST(BrdfFurnace, AGreyMixReflectsWhatItsTwoPartsReflect) {
    for (const float base : {0.2f, 0.5f, 0.8f}) {
        for (const double alpha : {0.1, 0.5}) {
            const auto reflect = [&](float metallic) {
                return directional_albedo(shipped_brdf,
                                          mix_material(vec3(base), metallic, vec3(0.04f), 1.0f, float(alpha)),
                                          view_at(45.0));
            };
            EXPECT_NEAR(reflect(0.5f), 0.5 * (reflect(0.0f) + reflect(1.0f)), 0.01) << base << ", " << alpha;
        }
    }
}

Brdf plant(EnergyMistake mistake) {
    return [mistake](const SurfaceMaterial& m, const vec3& v, const vec3& l) {
        const dvec3 view(clamp_view(v)), light(l);
        if (light.z <= 0.0) return 0.0;
        return oracle_brdf(m.diffuse_albedo.x, m.f0.x, m.f90, m.alpha, view, light,
                           shipped_albedos(m.alpha, view, light), mistake);
    };
}

bool passes_both_furnaces(const Brdf& brdf) {
    return is_white(find_extremes(brdf, 1.0, 0.04, 4, 4000)) &&
           is_white(find_extremes(brdf, 0.0, 1.0, 4, 4000));
}

TEST(BrdfFurnace, NegativeControlsEachMistakeInTheEnergyFailsTheSameChecks) {
    EXPECT_TRUE(passes_both_furnaces(plant(EnergyMistake::NONE)));
    for (const EnergyMistake mistake :
         {EnergyMistake::FORGET_MULTIPLE_SCATTERING, EnergyMistake::UNCOUPLED_BASE,
          EnergyMistake::MULTIPLE_SCATTERING_WITHOUT_MEAN, EnergyMistake::BASE_WITHOUT_MEAN,
          EnergyMistake::VIEW_FOR_LIGHT}) {
        EXPECT_FALSE(passes_both_furnaces(plant(mistake))) << "mistake " << int(mistake);
    }
}

// ---- All materials
// -------------------------------------------------------------------------------------------------------

struct FurnaceResult {
    double albedo = 0.0;
    double alpha = 0.0;
    double f0 = 0.0;
    double specular_weight = 0.0;
    double metallic = 0.0;
    double angle_deg = 0.0;
};

// The brightest view of one white material.
void find_brightest_view(const Brdf& brdf, double f0, double weight, double metallic,
                         FurnaceResult& brightest) {
    for (const double alpha : {1e-3, 0.01, 0.05, 0.1, 0.25, 0.5, 0.75, 1.0}) {
        for (const double angle : {0.0, 30.0, 60.0, 75.0, 85.0, 89.0, 89.9, 89.99}) {
            if (!is_resolved(alpha, angle)) continue;
            const SurfaceMaterial m = white_material(f0, weight, metallic, alpha);
            const double albedo = directional_albedo(brdf, m, view_at(angle), choose_point_count(alpha));
            if (albedo > brightest.albedo) brightest = {albedo, alpha, f0, weight, metallic, angle};
        }
    }
}

// The brightest white material over roughness, f0, specular weight, metallic and view.
FurnaceResult find_brightest(const Brdf& brdf) {
    FurnaceResult brightest;
    find_brightest_view(brdf, 0.04, 1.0, 1.0, brightest);  // a metal has no other f0
    for (const double metallic : {0.0, 0.5}) {
        find_brightest_view(brdf, 0.04, 0.0, metallic, brightest);  // nor has a surface without reflectance
        for (const double f0 : {0.04, 0.5, 1.0}) {
            for (const double weight : {0.5, 1.0}) find_brightest_view(brdf, f0, weight, metallic, brightest);
        }
    }
    return brightest;
}

TEST(BrdfFurnace, NoWhiteMaterialReflectsMoreThanArrives) {
    const FurnaceResult r = find_brightest(shipped_brdf);
    EXPECT_LE(r.albedo, MOST) << "alpha " << r.alpha << ", f0 " << r.f0 << ", weight " << r.specular_weight
                              << ", metallic " << r.metallic << ", " << r.angle_deg << " degrees";
    EXPECT_GE(r.albedo, 1.0 - 1e-3) << "Lambert is among them";
}

TEST(BrdfFurnace, NoRandomMaterialReflectsMoreThanArrives) {
    Draws draws(1);
    for (int i = 0; i < 1000; ++i) {
        const double f0 = draws.uniform(), roughness = draws.uniform();
        // Half of them white: the brightest.
        const double albedo = i % 2 == 0 ? 1.0 : draws.uniform(), f90 = draws.uniform(f0, 1.0);
        const SurfaceMaterial m =
            make_material(albedo, f0, f90, std::max(roughness * roughness, double(MIN_ALPHA)));
        const double angle = draws.uniform(0.0, 89.5);
        EXPECT_LE(directional_albedo(shipped_brdf, m, view_at(angle), choose_point_count(m.alpha)), MOST)
            << "alpha " << m.alpha << ", f0 " << f0 << ", f90 " << m.f90 << ", " << angle << " degrees";
    }
}

TEST(BrdfFurnace, NegativeControlTheSampleFormulaOfGltfFailsTheSameCheck) {
    // glTF 2.0, appendix B.3.5: the base is weighed with 1 - F(v.h) alone.
    const Brdf gltf_sample = [](const SurfaceMaterial& m, const vec3& v, const vec3& l) {
        const vec3 h = normalize(v + l);
        const double fresnel = fresnel_schlick(m.f0, m.f90, clamp(dot(v, h), 0.0f, 1.0f)).x;
        const double layer = double(evaluate_ggx(h, m.alpha)) * evaluate_visibility_smith(l.z, v.z, m.alpha);
        return (1.0 - fresnel) * m.diffuse_albedo.x * INV_PI + fresnel * layer;
    };
    const FurnaceResult r = find_brightest(gltf_sample);
    RecordProperty("albedo", std::to_string(r.albedo));
    std::printf("glTF sample formula: albedo %.3f at alpha %g, f0 %g, metallic %g, %g degrees\n", r.albedo,
                r.alpha, r.f0, r.metallic, r.angle_deg);
    EXPECT_GT(r.albedo, 1.5);
}

TEST(BrdfFurnace, ASmoothMirrorReflectsAllLightUpToGrazing) {
    for (const double angle : {0.0, 45.0, 80.0}) {
        EXPECT_NEAR(directional_albedo(shipped_brdf, make_material(0.0, 1.0, 1.0, 1e-3), view_at(angle)), 1.0,
                    2e-3);
    }
}

TEST(BrdfFurnace, NearGrazingADielectricApproachesAMirror) {
    const double albedo =
        directional_albedo(shipped_brdf, make_material(1.0, 0.04, 1.0, 0.01), view_at(89.9));
    EXPECT_GT(albedo, 0.8);
    EXPECT_LE(albedo, 1.0 + 1e-3);
}

}  // namespace
}  // namespace tarn
