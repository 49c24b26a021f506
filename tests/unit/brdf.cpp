// The BRDF: against a double-precision twin, its sampling against its density,
// and energy in a white furnace.
#include "shared/math/brdf.h"

#include <gtest/gtest.h>

#include <functional>

#include "core/statistics.h"
#include "support/brdf_oracle.h"
#include "support/draws.h"
#include "support/goodness_of_fit.h"
#include "support/histogram.h"

namespace tarn {
namespace {

using test::Draws;
using test::dvec2;
using test::dvec3;
using test::SIGNIFICANCE;
using test::view_at;

const double ALPHAS[] = {1e-3, 0.01, 0.1, 0.5, 1.0};
const double VIEW_ANGLES_DEG[] = {0.0, 45.0, 80.0, 89.0, 89.99};

SurfaceMaterial make_material(double albedo, double f0, double f90,
                              double alpha) {
  return {vec3(float(albedo)), vec3(float(f0)), float(f90), float(alpha)};
}

// The glTF mix of dielectric and metal, base colour white.
SurfaceMaterial white_material(double f0, double specular_weight,
                               double metallic, double alpha) {
  return make_material(1.0 - metallic,
                       glm::mix(f0 * specular_weight, 1.0, metallic),
                       glm::mix(specular_weight, 1.0, metallic), alpha);
}

using Brdf =
    std::function<double(const SurfaceMaterial &, const vec3 &, const vec3 &)>;

double shipped_brdf(const SurfaceMaterial &m, const vec3 &v, const vec3 &l) {
  return evaluate_brdf(m, v, l).x;
}

// Share of the light from `view` that leaves again, in a uniform sky.
double directional_albedo(const Brdf &brdf, const SurfaceMaterial &m,
                          const dvec3 &view, int point_count = 20'000) {
  return test::integrate_hemisphere(
      [&](const dvec3 &l) { return brdf(m, vec3(view), vec3(l)) * l.z; }, view,
      m.alpha, point_count);
}

// ---- Values
// -------------------------------------------------------------------------------------------------------

TEST(Brdf, EqualsTheTextbookFormulasInDoublePrecision) {
  Draws draws(1);
  for (const double alpha : ALPHAS) {
    for (int i = 0; i < 2000; ++i) {
      const double albedo = draws.uniform();
      const double f0 = draws.uniform();
      const double f90 = draws.uniform(f0, 1.0);
      const SurfaceMaterial m = make_material(albedo, f0, f90, alpha);
      const vec3 v = sample_cosine_hemisphere(draws.uniform_vec2());
      // Half of the directions within the highlight, where the value changes
      // fastest.
      const vec3 u = draws.uniform_vec3();
      const vec3 l =
          i % 2 == 0 ? sample_cosine_hemisphere(vec2(u)) : sample_brdf(m, v, u);
      if (v.z < 0.02f || l.z < 0.02f)
        continue;
      const double expected =
          test::oracle_brdf(m.diffuse_albedo.x, m.f0.x, m.f90, m.alpha,
                            glm::normalize(dvec3(v)), glm::normalize(dvec3(l)));
      // A half vector is rounded to 1e-7, which is 1e-7 / alpha of the
      // highlight's width; it counts four times.
      EXPECT_NEAR(shipped_brdf(m, v, l), expected,
                  (1e-5 + 2e-6 / alpha) * expected)
          << alpha;
    }
  }
}

TEST(Brdf, PdfEqualsTheTextbookFormulasInDoublePrecision) {
  Draws draws(2);
  for (const double alpha : ALPHAS) {
    for (int i = 0; i < 2000; ++i) {
      const double albedo = draws.uniform();
      const SurfaceMaterial m = make_material(albedo, 0.04, 1.0, alpha);
      const vec3 v = sample_cosine_hemisphere(draws.uniform_vec2());
      const vec3 l = sample_brdf(m, v, draws.uniform_vec3());
      if (v.z < 0.02f || l.z < 0.02f)
        continue;
      const dvec3 view = glm::normalize(dvec3(v));
      const double fresnel = test::schlick(m.f0.x, 1.0, view.z);
      const double layer =
          glm::clamp(fresnel / (fresnel + albedo * (1.0 - fresnel)), 0.1, 0.9);
      const dvec3 light = glm::normalize(dvec3(l));
      const double expected =
          (1.0 - layer) * light.z / M_PI +
          layer * test::oracle_layer_pdf(m.alpha, view, light);
      EXPECT_NEAR(pdf_brdf_solid_angle(m, v, l), expected,
                  (1e-5 + 2e-6 / alpha) * expected)
          << alpha;
    }
  }
}

TEST(Brdf, IsReciprocalAndNeverNegative) {
  Draws draws(3);
  for (const double alpha : ALPHAS) {
    for (int i = 0; i < 5000; ++i) {
      const SurfaceMaterial m{draws.uniform_vec3(), draws.uniform_vec3() * 0.5f,
                              1.0f, float(alpha)};
      const vec3 v = sample_cosine_hemisphere(draws.uniform_vec2());
      const vec3 l = sample_cosine_hemisphere(draws.uniform_vec2());
      if (v.z < MIN_VIEW_COSINE || l.z < MIN_VIEW_COSINE)
        continue;
      const vec3 forward = evaluate_brdf(m, v, l);
      const vec3 backward = evaluate_brdf(m, l, v);
      for (int c = 0; c < 3; ++c) {
        EXPECT_GE(forward[c], 0.0f);
        EXPECT_NEAR(forward[c], backward[c], 2e-6f * forward[c]);
      }
    }
  }
}

TEST(Brdf, WithoutReflectanceItIsLambertAndOnlyTheCosineIsSampled) {
  const SurfaceMaterial m = make_material(0.7, 0.0, 0.0, 0.25);
  const vec3 v = normalize(vec3(0.3f, 0.1f, 0.8f));
  EXPECT_FLOAT_EQ(evaluate_brdf(m, v, vec3(0.0f, 0.6f, 0.8f)).x, 0.7f * INV_PI);
  EXPECT_EQ(layer_probability(m, v), 0.0f);
  EXPECT_FLOAT_EQ(pdf_brdf_solid_angle(m, v, vec3(0.0f, 0.6f, 0.8f)),
                  0.8f * INV_PI);
}

TEST(Brdf, ABlackBaseSamplesTheLayerAlone) {
  EXPECT_EQ(layer_probability(make_material(0.0, 0.04, 1.0, 0.25),
                              vec3(0.0f, 0.0f, 1.0f)),
            1.0f);
}

TEST(Brdf, LightFromBelowReflectsNothingAndIsNeverSampled) {
  const SurfaceMaterial m = make_material(0.5, 0.04, 1.0, 0.25);
  const vec3 v(0.0f, 0.0f, 1.0f);
  for (const vec3 l : {vec3(0.0f, 0.0f, -1.0f), vec3(1.0f, 0.0f, 0.0f),
                       vec3(0.8f, 0.0f, -0.6f)}) {
    EXPECT_EQ(evaluate_brdf(m, v, l), vec3(0.0f));
    EXPECT_EQ(pdf_brdf_solid_angle(m, v, l), 0.0f);
  }
}

TEST(Brdf, NothingIsNanOrInfiniteOrNegativeInTheCornersOfItsDomain) {
  const vec3 directions[] = {
      {0, 0, 1},          {0, 0, -1},          {1, 0, 0},
      {-1, 0, 0},         {1, 0, 1e-30f},      {-1, 0, 1e-30f},
      {1, 0, 1e-7f},      {-1, 0, 1e-7f},      {0.6f, 0, 0.8f},
      {-0.6f, 0, -0.8f},  {0, 0.6f, -0.8f},    {1e-20f, 1e-20f, 1},
      {0, 1, 1.7453e-4f}, {0, -1, 1.7453e-4f}, {0, -1, -1.745e-4f}};
  const float last = 1.0f - 0x1p-24f;
  for (const double alpha : ALPHAS) {
    for (const double f0 : {0.0, 0.04, 1.0}) {
      for (const double albedo : {0.0, 1.0}) {
        const SurfaceMaterial m =
            make_material(albedo, f0, f0 > 0.0 ? 1.0 : 0.0, alpha);
        for (const vec3 &v : directions) {
          for (const vec3 &l : directions) {
            const float value = evaluate_brdf(m, v, l).x;
            const float pdf = pdf_brdf_solid_angle(m, v, l);
            EXPECT_TRUE(is_finite(value) && value >= 0.0f) << value;
            EXPECT_TRUE(is_finite(pdf) && pdf >= 0.0f) << pdf;
            EXPECT_TRUE(value == 0.0f || pdf > 0.0f)
                << "light that is never sampled";
          }
          for (const float a : {0.0f, 0.5f, last}) {
            for (const float b : {0.0f, 0.25f, 0.5f, last}) {
              for (const float c : {0.0f, 0.5f, last}) {
                EXPECT_NEAR(length(sample_brdf(m, v, vec3(a, b, c))), 1.0f,
                            2e-6f);
              }
            }
          }
        }
      }
    }
  }
}

// ---- Sampling
// -----------------------------------------------------------------------------------------------------

using Pdf =
    std::function<double(const SurfaceMaterial &, const vec3 &, const vec3 &)>;

double shipped_pdf(const SurfaceMaterial &m, const vec3 &v, const vec3 &l) {
  return pdf_brdf_solid_angle(m, v, l);
}

// Bins over half vectors, and one for directions below the surface.
struct HalfVectorBins {
  static constexpr int SIDE = 20;
  std::vector<double> above = std::vector<double>(SIDE * SIDE);
  double below = 0.0;
};

HalfVectorBins count_samples(const SurfaceMaterial &m, const dvec3 &view,
                             int sample_count) {
  Draws draws(4);
  HalfVectorBins counts;
  for (int i = 0; i < sample_count; ++i) {
    const vec3 l = sample_brdf(m, vec3(view), draws.uniform_vec3());
    if (l.z <= 0.0f) {
      ++counts.below;
      continue;
    }
    const dvec2 square =
        test::half_vector_square(glm::normalize(view + dvec3(l)), m.alpha);
    const int column = std::min(int(square.x * counts.SIDE), counts.SIDE - 1);
    const int row = std::min(int(square.y * counts.SIDE), counts.SIDE - 1);
    ++counts.above[row * counts.SIDE + column];
  }
  return counts;
}

// Integrals of the pdf over the same bins; `below` is what is left of 1.
HalfVectorBins integrate_pdf(const Pdf &pdf, const SurfaceMaterial &m,
                             const dvec3 &view) {
  constexpr int STEPS = 24;
  const int side = HalfVectorBins::SIDE * STEPS;
  HalfVectorBins bins;
  double total = 0.0;
  for (int i = 0; i < side; ++i) {
    for (int j = 0; j < side; ++j) {
      const dvec2 u((i + 0.5) / side, (j + 0.5) / side);
      const dvec3 h = test::half_vector_at(u, m.alpha);
      const double cos_h = glm::dot(view, h);
      const dvec3 l = test::reflect_about(view, h);
      if (cos_h <= 0.0 || l.z <= 0.0)
        continue;
      const double density = pdf(m, vec3(view), vec3(l)) * 4.0 * cos_h *
                             test::half_vector_jacobian(u, m.alpha);
      bins.above[(j / STEPS) * bins.SIDE + i / STEPS] +=
          density / (double(side) * side);
      total += density / (double(side) * side);
    }
  }
  bins.below = 1.0 - total;
  return bins;
}

// p value of "sample_brdf returns directions with density `pdf`".
double sampling_p_value(const Pdf &pdf, const SurfaceMaterial &m,
                        const dvec3 &view) {
  constexpr int SAMPLE_COUNT = 100'000;
  const HalfVectorBins counted = count_samples(m, view, SAMPLE_COUNT);
  const HalfVectorBins promised = integrate_pdf(pdf, m, view);
  std::vector<double> observed = counted.above;
  std::vector<double> expected = promised.above;
  for (double &e : expected)
    e *= SAMPLE_COUNT;
  observed.push_back(counted.below);
  expected.push_back(std::max(promised.below, 0.0) * SAMPLE_COUNT);
  // Midpoint quadrature cannot promise an exact 0, nor can rounding at a bin's
  // edge.
  for (double &e : expected)
    e = std::max(e, 1e-3);
  return chi_square_test(observed, expected).p_value;
}

// At 89.99 degrees, v + l of a highlight of width 1e-3 is a difference of
// numbers near 1: its rounding is a sixth of the highlight's width, so that
// neither side of the comparison is defined there.
bool is_resolved(double alpha, double angle_deg) {
  return alpha >= 0.01 || angle_deg < 89.9;
}

TEST(BrdfSampling, LayerFollowsItsPdfAtAllWidthsAndViews) {
  for (const double alpha : ALPHAS) {
    for (const double angle : VIEW_ANGLES_DEG) {
      if (!is_resolved(alpha, angle))
        continue;
      EXPECT_GT(sampling_p_value(shipped_pdf,
                                 make_material(0.0, 0.5, 1.0, alpha),
                                 view_at(angle)),
                sidak_threshold(SIGNIFICANCE, 25))
          << "alpha " << alpha << ", " << angle << " degrees";
    }
  }
}

TEST(BrdfSampling, BaseAndLayerTogetherFollowTheirPdf) {
  for (const double alpha : {0.25, 0.5, 1.0}) {
    for (const double angle : VIEW_ANGLES_DEG) {
      EXPECT_GT(sampling_p_value(shipped_pdf,
                                 make_material(0.6, 0.04, 1.0, alpha),
                                 view_at(angle)),
                sidak_threshold(SIGNIFICANCE, 15))
          << "alpha " << alpha << ", " << angle << " degrees";
    }
  }
}

TEST(BrdfSampling, PdfIntegratesToOneLessWhatFallsBelowTheSurface) {
  for (const double alpha : ALPHAS) {
    for (const double angle : VIEW_ANGLES_DEG) {
      if (!is_resolved(alpha, angle))
        continue;
      const SurfaceMaterial m = make_material(0.6, 0.04, 1.0, alpha);
      const dvec3 view = view_at(angle);
      const double total = test::integrate_hemisphere(
          [&](const dvec3 &l) { return shipped_pdf(m, vec3(view), vec3(l)); },
          view, m.alpha, 100'000);
      EXPECT_LE(total, 1.0 + 1e-3)
          << "alpha " << alpha << ", " << angle << " degrees";
      constexpr int COUNT = 20'000;
      const double below = count_samples(m, view, COUNT).below / COUNT;
      EXPECT_NEAR(total, 1.0 - below,
                  1e-3 + 4.5 * std::sqrt((below + 1e-4) / COUNT))
          << "alpha " << alpha << ", " << angle << " degrees";
    }
  }
}

// z of the mean of f cos / pdf over samples against quadrature of the
// double-precision twin.
double estimator_z(const Pdf &pdf, const SurfaceMaterial &m,
                   const dvec3 &view) {
  Draws draws(5);
  RunningMoments moments;
  for (int i = 0; i < 200'000; ++i) {
    const vec3 l = sample_brdf(m, vec3(view), draws.uniform_vec3());
    const double density = l.z > 0.0f ? pdf(m, vec3(view), l) : 0.0;
    moments.add(density > 0.0 ? shipped_brdf(m, vec3(view), l) * l.z / density
                              : 0.0);
  }
  const double truth = test::integrate_hemisphere(
      [&](const dvec3 &l) {
        return test::oracle_brdf(m.diffuse_albedo.x, m.f0.x, m.f90, m.alpha,
                                 view, l) *
               l.z;
      },
      view, m.alpha, 100'000);
  // Quadrature and single precision: 2e-4 of the value.
  return (moments.mean() - truth) /
         (std::sqrt(moments.variance_of_mean()) + 2e-4 * truth);
}

TEST(BrdfSampling, MeanOfTheEstimatorIsTheIntegral) {
  for (const double alpha : ALPHAS) {
    for (const double angle : VIEW_ANGLES_DEG) {
      if (!is_resolved(alpha, angle))
        continue;
      const double z = estimator_z(
          shipped_pdf, make_material(0.6, 0.2, 1.0, alpha), view_at(angle));
      EXPECT_GT(normal_two_sided_p_value(z), sidak_threshold(SIGNIFICANCE, 25))
          << "alpha " << alpha << ", " << angle << " degrees, z = " << z;
    }
  }
}

TEST(BrdfSampling, NegativeControlAPdfWithoutTheQuarterFailsBothChecks) {
  // The Jacobian of reflection is 1 / (4 v.h); here its 4 is lost.
  const Pdf lost_quarter = [](const SurfaceMaterial &m, const vec3 &v,
                              const vec3 &l) {
    const double layer = layer_probability(m, v);
    const double base_pdf = (1.0 - layer) * l.z * INV_PI;
    return base_pdf + 4.0 * (pdf_brdf_solid_angle(m, v, l) - base_pdf);
  };
  const SurfaceMaterial m = make_material(0.6, 0.2, 1.0, 0.5);
  EXPECT_LT(sampling_p_value(lost_quarter, m, view_at(45.0)), SIGNIFICANCE);
  EXPECT_LT(
      normal_two_sided_p_value(estimator_z(lost_quarter, m, view_at(45.0))),
      SIGNIFICANCE);
}

// ---- Energy
// -------------------------------------------------------------------------------------------------------

TEST(BrdfFurnace, WhiteLambertReflectsAllLight) {
  for (const double angle : VIEW_ANGLES_DEG) {
    EXPECT_NEAR(directional_albedo(shipped_brdf,
                                   make_material(1.0, 0.0, 0.0, 0.5),
                                   view_at(angle)),
                1.0, 1e-3);
  }
}

struct FurnaceResult {
  double albedo = 0.0;
  double alpha = 0.0;
  double f0 = 0.0;
  double specular_weight = 0.0;
  double metallic = 0.0;
  double angle_deg = 0.0;
};

// The brightest view of one white material.
void find_brightest_view(const Brdf &brdf, double f0, double weight,
                         double metallic, FurnaceResult &brightest) {
  for (const double alpha : {1e-3, 0.01, 0.05, 0.1, 0.25, 0.5, 0.75, 1.0}) {
    for (const double angle :
         {0.0, 30.0, 60.0, 75.0, 85.0, 89.0, 89.9, 89.99}) {
      if (!is_resolved(alpha, angle))
        continue;
      const SurfaceMaterial m = white_material(f0, weight, metallic, alpha);
      const double albedo = directional_albedo(brdf, m, view_at(angle), 4000);
      if (albedo > brightest.albedo)
        brightest = {albedo, alpha, f0, weight, metallic, angle};
    }
  }
}

// The brightest white material over roughness, f0, specular weight, metallic
// and view.
FurnaceResult find_brightest(const Brdf &brdf) {
  FurnaceResult brightest;
  find_brightest_view(brdf, 0.04, 1.0, 1.0,
                      brightest); // a metal has no other f0
  for (const double metallic : {0.0, 0.5}) {
    find_brightest_view(brdf, 0.04, 0.0, metallic,
                        brightest); // nor has a surface without reflectance
    for (const double f0 : {0.04, 0.5, 1.0}) {
      for (const double weight : {0.5, 1.0})
        find_brightest_view(brdf, f0, weight, metallic, brightest);
    }
  }
  return brightest;
}

TEST(BrdfFurnace, NoWhiteMaterialReflectsMoreThanArrives) {
  const FurnaceResult r = find_brightest(shipped_brdf);
  EXPECT_LE(r.albedo, 1.0 + 1e-3)
      << "alpha " << r.alpha << ", f0 " << r.f0 << ", weight "
      << r.specular_weight << ", metallic " << r.metallic << ", " << r.angle_deg
      << " degrees";
  EXPECT_GE(r.albedo, 1.0 - 1e-3) << "Lambert is among them";
}

TEST(BrdfFurnace, NegativeControlTheSampleFormulaOfGltfFailsTheSameCheck) {
  // glTF 2.0, appendix B.3.5: the base is weighed with 1 - F(v.h) alone.
  const Brdf gltf_sample = [](const SurfaceMaterial &m, const vec3 &v,
                              const vec3 &l) {
    const vec3 h = normalize(v + l);
    const double fresnel =
        fresnel_schlick(m.f0, m.f90, clamp(dot(v, h), 0.0f, 1.0f)).x;
    const double layer = double(evaluate_ggx(h, m.alpha)) *
                         evaluate_visibility_smith(l.z, v.z, m.alpha);
    return (1.0 - fresnel) * m.diffuse_albedo.x * INV_PI + fresnel * layer;
  };
  const FurnaceResult r = find_brightest(gltf_sample);
  RecordProperty("albedo", std::to_string(r.albedo));
  std::printf("glTF sample formula: albedo %.3f at alpha %g, f0 %g, metallic "
              "%g, %g degrees\n",
              r.albedo, r.alpha, r.f0, r.metallic, r.angle_deg);
  EXPECT_GT(r.albedo, 1.5);
}

TEST(BrdfFurnace, ASmoothMirrorReflectsAllLightUpToGrazing) {
  for (const double angle : {0.0, 45.0, 80.0}) {
    EXPECT_NEAR(directional_albedo(shipped_brdf,
                                   make_material(0.0, 1.0, 1.0, 1e-3),
                                   view_at(angle)),
                1.0, 2e-3);
  }
}

TEST(BrdfFurnace, NearGrazingADielectricApproachesAMirror) {
  const double albedo = directional_albedo(
      shipped_brdf, make_material(1.0, 0.04, 1.0, 0.01), view_at(89.9));
  EXPECT_GT(albedo, 0.8);
  EXPECT_LE(albedo, 1.0 + 1e-3);
}

} // namespace
} // namespace tarn
