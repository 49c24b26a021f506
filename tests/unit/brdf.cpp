// The BRDF against a double-precision twin, and its sampling against its density.
#include "shared/math/brdf.h"

#include <gtest/gtest.h>

#include <functional>

#include "core/statistics.h"
#include "shared/math/shading.h"
#include "support/brdf_cases.h"
#include "support/draws.h"
#include "support/goodness_of_fit.h"
#include "support/histogram.h"

namespace tarn {
namespace {

using namespace test;

// ---- Values
// -------------------------------------------------------------------------------------------------------

// The twin with the albedos of the shipped fits: equal to rounding.
double oracle(const SurfaceMaterial& m, const dvec3& v, const dvec3& l) {
    return test::oracle_brdf(m.diffuse_albedo.x, m.f0.x, m.f90, m.alpha, v, l,
                             test::shipped_albedos(m.alpha, v, l));
}

TEST(Brdf, EqualsThePapersFormulasInDoublePrecision) {
    Draws draws(1);
    for (const double alpha : ALPHAS) {
        for (int i = 0; i < 2000; ++i) {
            const double albedo = draws.uniform();
            const double f0 = draws.uniform();
            const double f90 = draws.uniform(f0, 1.0);
            const SurfaceMaterial m = make_material(albedo, f0, f90, alpha);
            const vec3 v = sample_cosine_hemisphere(draws.uniform_vec2());
            // Half of the directions within the highlight, where the value changes fastest.
            const vec3 u = draws.uniform_vec3();
            const vec3 l = i % 2 == 0 ? sample_cosine_hemisphere(vec2(u)) : sample_brdf(m, v, u);
            if (v.z < 0.02f || l.z < 0.02f) continue;
            const double expected = oracle(m, glm::normalize(dvec3(v)), glm::normalize(dvec3(l)));
            // A half vector is rounded to 1e-7, which is 1e-7 / alpha of the highlight's width; it counts
            // four times.
            EXPECT_NEAR(shipped_brdf(m, v, l), expected, (1e-5 + 2e-6 / alpha) * expected) << alpha;
        }
    }
}

// The layer's share of what a grey surface reflects, the layer's single scattering alone; at least a tenth.
double expected_layer_probability(double albedo, double f0, double alpha, const dvec3& view) {
    const auto [at_view, at_light, mean] = test::shipped_albedos(alpha, view, view);
    const double layer = f0 * (at_view.whole - at_view.grazing) + at_view.grazing;
    const double mean_schlick = f0 + (1.0 - f0) / 21.0;
    const double multiple = mean_schlick * mean_schlick * mean.whole /
                            (1.0 - mean_schlick * (1.0 - mean.whole)) * (1.0 - at_view.whole);
    return std::max(layer / (layer + multiple + albedo * (1.0 - layer - multiple)), 0.1);
}

TEST(Brdf, PdfEqualsThePapersFormulasInDoublePrecision) {
    Draws draws(2);
    for (const double alpha : ALPHAS) {
        for (int i = 0; i < 2000; ++i) {
            const double albedo = draws.uniform();
            const SurfaceMaterial m = make_material(albedo, 0.04, 1.0, alpha);
            const vec3 v = sample_cosine_hemisphere(draws.uniform_vec2());
            const vec3 l = sample_brdf(m, v, draws.uniform_vec3());
            if (v.z < 0.02f || l.z < 0.02f) continue;
            const dvec3 view = glm::normalize(dvec3(v));
            const double layer = expected_layer_probability(albedo, m.f0.x, m.alpha, view);
            const dvec3 light = glm::normalize(dvec3(l));
            const double expected =
                (1.0 - layer) * light.z / M_PI + layer * test::oracle_layer_pdf(m.alpha, view, light);
            EXPECT_NEAR(pdf_brdf_solid_angle(m, v, l), expected, (1e-5 + 2e-6 / alpha) * expected) << alpha;
        }
    }
}

TEST(Brdf, IsReciprocalAndNeverNegative) {
    Draws draws(3);
    for (const double alpha : ALPHAS) {
        for (int i = 0; i < 5000; ++i) {
            const SurfaceMaterial m{draws.uniform_vec3(), draws.uniform_vec3() * 0.5f, 1.0f, float(alpha)};
            const vec3 v = sample_cosine_hemisphere(draws.uniform_vec2());
            const vec3 l = sample_cosine_hemisphere(draws.uniform_vec2());
            if (v.z < MIN_VIEW_COSINE || l.z < MIN_VIEW_COSINE) continue;
            const vec3 forward = evaluate_brdf(m, v, l);
            const vec3 backward = evaluate_brdf(m, l, v);
            for (int c = 0; c < 3; ++c) {
                EXPECT_GE(forward[c], 0.0f);
                EXPECT_NEAR(forward[c], backward[c], 2e-6f * forward[c]);
            }
        }
    }
}

TEST(Brdf, ItsPartsAreTheDemodulatedBaseAndTheLayer) {
    Draws draws(6);
    for (int i = 0; i < 5000; ++i) {
        SurfaceMaterial m{draws.uniform_vec3(), draws.uniform_vec3(), 1.0f, float(draws.uniform(1e-3, 1.0))};
        const vec3 v = sample_cosine_hemisphere(draws.uniform_vec2());
        const vec3 l = sample_cosine_hemisphere(draws.uniform_vec2());
        const BrdfValue parts = evaluate_brdf_parts(m, v, l);
        EXPECT_EQ(evaluate_brdf(m, v, l), m.diffuse_albedo * parts.diffuse + parts.specular);
        const BrdfValue once_prepared = evaluate_brdf_parts(m, prepare_brdf(m, v), l);
        EXPECT_EQ(once_prepared.diffuse, parts.diffuse);
        EXPECT_EQ(once_prepared.specular, parts.specular);
        m.diffuse_albedo = vec3(0.0f);
        EXPECT_EQ(evaluate_brdf_parts(m, v, l).diffuse, parts.diffuse) << "the base holds its albedo";
        EXPECT_EQ(evaluate_brdf(m, v, l), parts.specular);
    }
}

TEST(Brdf, PartsOfReflectedLightAreThoseOfTheBrdfTimesTheCosine) {
    Draws draws(7);
    for (int i = 0; i < 2000; ++i) {
        const vec3 normal = draws.unit_vector();
        ShadingPoint p{vec3(0.0f), 0.0f, normal, normal, make_material(0.6, 0.04, 1.0, 0.2)};
        const Frame frame = make_frame(normal);
        const vec3 view = sample_cosine_hemisphere(draws.uniform_vec2());
        IncidentLight incident{};
        incident.direction = draws.unit_vector();
        incident.value = draws.uniform_vec3();
        const vec3 local = to_local(frame, incident.direction);
        const BrdfValue brdf = evaluate_brdf_parts(p.material, view, local);
        const BrdfValue parts = reflect_light_parts(p, frame, view, incident);
        const vec3 arriving = incident.value * max(local.z, 0.0f);
        for (int c = 0; c < 3; ++c) {
            EXPECT_FLOAT_EQ(parts.diffuse[c], brdf.diffuse[c] * arriving[c]);
            EXPECT_FLOAT_EQ(parts.specular[c], brdf.specular[c] * arriving[c]);
        }
        EXPECT_EQ(reflect_light(p, frame, view, incident),
                  p.material.diffuse_albedo * parts.diffuse + parts.specular);
    }
}

TEST(Brdf, WithoutReflectanceItIsLambertAndOnlyTheCosineIsSampled) {
    const SurfaceMaterial m = make_material(0.7, 0.0, 0.0, 0.25);
    const vec3 v = normalize(vec3(0.3f, 0.1f, 0.8f));
    EXPECT_FLOAT_EQ(evaluate_brdf(m, v, vec3(0.0f, 0.6f, 0.8f)).x, 0.7f * INV_PI);
    EXPECT_EQ(layer_probability(m, v), 0.0f);
    EXPECT_FLOAT_EQ(pdf_brdf_solid_angle(m, v, vec3(0.0f, 0.6f, 0.8f)), 0.8f * INV_PI);
}

TEST(Brdf, ASmoothMirrorSamplesTheLayerAlmostAlone) {
    EXPECT_GT(layer_probability(make_material(0.0, 1.0, 1.0, 1e-3), vec3(0.0f, 0.0f, 1.0f)), 0.999f);
}

TEST(Brdf, ARoughMirrorSamplesTheCosineForWhatItScattersMoreThanOnce) {
    // At width 1, ln 2 of the light from straight above is lost to single scattering.
    EXPECT_NEAR(layer_probability(make_material(0.0, 1.0, 1.0, 1.0), vec3(0.0f, 0.0f, 1.0f)),
                1.0 - std::log(2.0), 0.01);
}

TEST(Brdf, LightFromBelowReflectsNothingAndIsNeverSampled) {
    const SurfaceMaterial m = make_material(0.5, 0.04, 1.0, 0.25);
    const vec3 v(0.0f, 0.0f, 1.0f);
    for (const vec3 l : {vec3(0.0f, 0.0f, -1.0f), vec3(1.0f, 0.0f, 0.0f), vec3(0.8f, 0.0f, -0.6f)}) {
        EXPECT_EQ(evaluate_brdf(m, v, l), vec3(0.0f));
        EXPECT_EQ(pdf_brdf_solid_angle(m, v, l), 0.0f);
    }
}

TEST(Brdf, NothingIsNanOrInfiniteOrNegativeInTheCornersOfItsDomain) {
    const vec3 directions[] = {
        {0, 0, 1},        {0, 0, -1},          {1, 0, 0},          {-1, 0, 0},          {1, 0, 1e-30f},
        {-1, 0, 1e-30f},  {1, 0, 1e-7f},       {-1, 0, 1e-7f},     {0.6f, 0, 0.8f},     {-0.6f, 0, -0.8f},
        {0, 0.6f, -0.8f}, {1e-20f, 1e-20f, 1}, {0, 1, 1.7453e-4f}, {0, -1, 1.7453e-4f}, {0, -1, -1.745e-4f}};
    const float last = 1.0f - 0x1p-24f;
    for (const double alpha : ALPHAS) {
        for (const double f0 : {0.0, 0.04, 1.0}) {
            for (const double albedo : {0.0, 1.0}) {
                const SurfaceMaterial m = make_material(albedo, f0, f0 > 0.0 ? 1.0 : 0.0, alpha);
                for (const vec3& v : directions) {
                    for (const vec3& l : directions) {
                        const float value = evaluate_brdf(m, v, l).x;
                        const float pdf = pdf_brdf_solid_angle(m, v, l);
                        EXPECT_TRUE(is_finite(value) && value >= 0.0f) << value;
                        EXPECT_TRUE(is_finite(pdf) && pdf >= 0.0f) << pdf;
                        EXPECT_TRUE(value == 0.0f || pdf > 0.0f) << "light that is never sampled";
                    }
                    for (const float a : {0.0f, 0.5f, last}) {
                        for (const float b : {0.0f, 0.25f, 0.5f, last}) {
                            for (const float c : {0.0f, 0.5f, last}) {
                                EXPECT_NEAR(length(sample_brdf(m, v, vec3(a, b, c))), 1.0f, 2e-6f);
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

using Pdf = std::function<double(const SurfaceMaterial&, const vec3&, const vec3&)>;

double shipped_pdf(const SurfaceMaterial& m, const vec3& v, const vec3& l) {
    return pdf_brdf_solid_angle(m, v, l);
}

// Bins over half vectors, and one for directions below the surface.
struct HalfVectorBins {
    static constexpr int SIDE = 20;
    std::vector<double> above = std::vector<double>(SIDE * SIDE);
    double below = 0.0;
};

HalfVectorBins count_samples(const SurfaceMaterial& m, const dvec3& view, int sample_count) {
    Draws draws(4);
    HalfVectorBins counts;
    for (int i = 0; i < sample_count; ++i) {
        const vec3 l = sample_brdf(m, vec3(view), draws.uniform_vec3());
        if (l.z <= 0.0f) {
            ++counts.below;
            continue;
        }
        const dvec2 square = test::half_vector_square(glm::normalize(view + dvec3(l)), m.alpha);
        const int column = std::min(int(square.x * counts.SIDE), counts.SIDE - 1);
        const int row = std::min(int(square.y * counts.SIDE), counts.SIDE - 1);
        ++counts.above[row * counts.SIDE + column];
    }
    return counts;
}

// Integrals of the pdf over the same bins; `below` is what is left of 1.
HalfVectorBins integrate_pdf(const Pdf& pdf, const SurfaceMaterial& m, const dvec3& view) {
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
            if (cos_h <= 0.0 || l.z <= 0.0) continue;
            const double density =
                pdf(m, vec3(view), vec3(l)) * 4.0 * cos_h * test::half_vector_jacobian(u, m.alpha);
            bins.above[(j / STEPS) * bins.SIDE + i / STEPS] += density / (double(side) * side);
            total += density / (double(side) * side);
        }
    }
    bins.below = 1.0 - total;
    return bins;
}

// p value of "sample_brdf returns directions with density `pdf`".
double sampling_p_value(const Pdf& pdf, const SurfaceMaterial& m, const dvec3& view) {
    constexpr int SAMPLE_COUNT = 100'000;
    const HalfVectorBins counted = count_samples(m, view, SAMPLE_COUNT);
    const HalfVectorBins promised = integrate_pdf(pdf, m, view);
    std::vector<double> observed = counted.above;
    std::vector<double> expected = promised.above;
    for (double& e : expected) e *= SAMPLE_COUNT;
    observed.push_back(counted.below);
    expected.push_back(std::max(promised.below, 0.0) * SAMPLE_COUNT);
    // Midpoint quadrature cannot promise an exact 0, nor can rounding at a bin's edge.
    for (double& e : expected) e = std::max(e, 1e-3);
    return chi_square_test(observed, expected).p_value;
}

TEST(BrdfSampling, LayerFollowsItsPdfAtAllWidthsAndViews) {
    for (const double alpha : ALPHAS) {
        for (const double angle : VIEW_ANGLES_DEG) {
            if (!is_resolved(alpha, angle)) continue;
            EXPECT_GT(sampling_p_value(shipped_pdf, make_material(0.0, 0.5, 1.0, alpha), view_at(angle)),
                      sidak_threshold(SIGNIFICANCE, 25))
                << "alpha " << alpha << ", " << angle << " degrees";
        }
    }
}

TEST(BrdfSampling, BaseAndLayerTogetherFollowTheirPdf) {
    for (const double alpha : {0.25, 0.5, 1.0}) {
        for (const double angle : VIEW_ANGLES_DEG) {
            EXPECT_GT(sampling_p_value(shipped_pdf, make_material(0.6, 0.04, 1.0, alpha), view_at(angle)),
                      sidak_threshold(SIGNIFICANCE, 15))
                << "alpha " << alpha << ", " << angle << " degrees";
        }
    }
}

TEST(BrdfSampling, PdfIntegratesToOneLessWhatFallsBelowTheSurface) {
    for (const double alpha : ALPHAS) {
        for (const double angle : VIEW_ANGLES_DEG) {
            if (!is_resolved(alpha, angle)) continue;
            const SurfaceMaterial m = make_material(0.6, 0.04, 1.0, alpha);
            const dvec3 view = view_at(angle);
            const double total = test::integrate_hemisphere(
                [&](const dvec3& l) { return shipped_pdf(m, vec3(view), vec3(l)); }, view, m.alpha, 100'000);
            EXPECT_LE(total, 1.0 + 1e-3) << "alpha " << alpha << ", " << angle << " degrees";
            constexpr int COUNT = 20'000;
            const double below = count_samples(m, view, COUNT).below / COUNT;
            EXPECT_NEAR(total, 1.0 - below, 1e-3 + 4.5 * std::sqrt((below + 1e-4) / COUNT))
                << "alpha " << alpha << ", " << angle << " degrees";
        }
    }
}

// z of the mean of f cos / pdf over samples against quadrature of the double-precision twin.
double estimator_z(const Pdf& pdf, const SurfaceMaterial& m, const dvec3& view) {
    Draws draws(5);
    RunningMoments moments;
    for (int i = 0; i < 200'000; ++i) {
        const vec3 l = sample_brdf(m, vec3(view), draws.uniform_vec3());
        const double density = l.z > 0.0f ? pdf(m, vec3(view), l) : 0.0;
        moments.add(density > 0.0 ? shipped_brdf(m, vec3(view), l) * l.z / density : 0.0);
    }
    const double truth = test::integrate_hemisphere([&](const dvec3& l) { return oracle(m, view, l) * l.z; },
                                                    view, m.alpha, 100'000);
    // Quadrature and single precision: 2e-4 of the value.
    return (moments.mean() - truth) / (std::sqrt(moments.variance_of_mean()) + 2e-4 * truth);
}

TEST(BrdfSampling, MeanOfTheEstimatorIsTheIntegral) {
    for (const double alpha : ALPHAS) {
        for (const double angle : VIEW_ANGLES_DEG) {
            if (!is_resolved(alpha, angle)) continue;
            const double z = estimator_z(shipped_pdf, make_material(0.6, 0.2, 1.0, alpha), view_at(angle));
            EXPECT_GT(normal_two_sided_p_value(z), sidak_threshold(SIGNIFICANCE, 25))
                << "alpha " << alpha << ", " << angle << " degrees, z = " << z;
        }
    }
}

TEST(BrdfSampling, NegativeControlAPdfWithoutTheQuarterFailsBothChecks) {
    // The Jacobian of reflection is 1 / (4 v.h); here its 4 is lost.
    const Pdf lost_quarter = [](const SurfaceMaterial& m, const vec3& v, const vec3& l) {
        const double layer = layer_probability(m, v);
        const double base_pdf = (1.0 - layer) * l.z * INV_PI;
        return base_pdf + 4.0 * (pdf_brdf_solid_angle(m, v, l) - base_pdf);
    };
    const SurfaceMaterial m = make_material(0.6, 0.2, 1.0, 0.5);
    EXPECT_LT(sampling_p_value(lost_quarter, m, view_at(45.0)), SIGNIFICANCE);
    EXPECT_LT(normal_two_sided_p_value(estimator_z(lost_quarter, m, view_at(45.0))), SIGNIFICANCE);
}

}  // namespace
}  // namespace tarn
