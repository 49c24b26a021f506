// The fits of the layer's directional albedo against quadrature and closed forms.
#include "shared/math/layer_albedo.h"

#include <gtest/gtest.h>

#include "support/brdf_cases.h"
#include "support/draws.h"
#include "support/layer_oracle.h"

namespace tarn {
namespace {

using namespace test;

// A fit below the truth lets a surface reflect more than arrives, one above it darkens.
constexpr double MOST_BELOW = 1e-3;
constexpr double MOST_ABOVE = 6e-3;
constexpr double MOST_ABOVE_AT_GRAZING = 1e-2;  // beyond 85 degrees
// Of the tables that serve as truth.
constexpr double QUADRATURE_ERROR = 3e-4;

double alpha_of(double roughness) {
    return std::max(roughness * roughness, double(MIN_ALPHA));
}

struct Interval {
    double least = INFINITY;
    double greatest = -INFINITY;

    void add(double x) {
        least = std::min(least, x);
        greatest = std::max(greatest, x);
    }
};

// Fit less truth over all widths and angles of a range, where the fits are given `alpha_factor` times the
// width.
Interval find_errors(double first_deg, double last_deg, double alpha_factor = 1.0) {
    Interval errors;
    for (int i = 0; i <= 20; ++i) {
        const double alpha = alpha_of(i / 20.0);
        const LayerFit fit = fit_layer(float(std::min(alpha * alpha_factor, 1.0)));
        for (int k = 0; k <= 12; ++k) {
            const double angle = glm::mix(first_deg, last_deg, k / 12.0);
            const double cosine = std::cos(angle * M_PI / 180.0);
            const OracleAlbedo truth = integrate_layer(alpha, cosine, 10'000);
            const LayerAlbedo fitted = evaluate_layer_albedo(fit, float(cosine));
            errors.add(1.0 - fitted.loss - truth.whole);
            errors.add(fitted.fresnel - truth.grazing);
        }
    }
    return errors;
}

TEST(LayerAlbedo, EqualsQuadratureAtAllWidthsAndAngles) {
    const Interval steep = find_errors(0.0, 85.0);
    const Interval grazing = find_errors(85.0, 89.9);
    std::printf("fit less truth: %.5f to %.5f up to 85 degrees, %.5f to %.5f beyond\n", steep.least,
                steep.greatest, grazing.least, grazing.greatest);
    EXPECT_GT(std::min(steep.least, grazing.least), -MOST_BELOW);
    EXPECT_LT(steep.greatest, MOST_ABOVE);
    EXPECT_LT(grazing.greatest, MOST_ABOVE_AT_GRAZING);
}

TEST(LayerAlbedo, NegativeControlTheAlbedosOfAWiderLayerFailTheSameCheck) {
    const Interval steep = find_errors(0.0, 85.0, 1.1);
    EXPECT_TRUE(steep.least < -MOST_BELOW || steep.greatest > MOST_ABOVE);
}

TEST(LayerAlbedo, AtWidthOneSingleScatteringLosesLn2StraightDown) {
    // Of D G2 / (4 n.l) at n.v = alpha = 1 the integral over the half vectors is elementary.
    EXPECT_NEAR(evaluate_layer_albedo(fit_layer(1.0f), 1.0f).loss, std::log(2.0), MOST_ABOVE);
}

TEST(LayerAlbedo, ASmoothLayerLosesNothingAndFollowsSchlick) {
    const LayerFit fit = fit_layer(MIN_ALPHA);
    for (const double cosine : {0.1, 0.3, 0.6, 1.0}) {
        const LayerAlbedo a = evaluate_layer_albedo(fit, float(cosine));
        EXPECT_NEAR(a.loss, 0.0, MOST_BELOW);
        EXPECT_NEAR(a.fresnel, std::pow(1.0 - cosine, 5.0), MOST_ABOVE);
    }
}

// Means of the fits over the hemisphere, weighed with the cosine, and the greatest loss.
struct FitMeans {
    double loss = 0.0, fresnel = 0.0, greatest_loss = 0.0;
};

FitMeans integrate_fit(double alpha) {
    constexpr int STEPS = 20'000;
    const LayerFit fit = fit_layer(float(alpha));
    FitMeans means;
    for (int i = 0; i < STEPS; ++i) {
        const double t = (i + 0.5) / STEPS;
        const LayerAlbedo a = evaluate_layer_albedo(fit, float(t * t * t));
        const double weight = 6.0 * std::pow(t, 5.0) / STEPS;
        means.loss += weight * a.loss;
        means.fresnel += weight * a.fresnel;
        means.greatest_loss = std::max(means.greatest_loss, double(a.loss));
    }
    return means;
}

TEST(LayerAlbedo, MeansAreThoseOfTheFitsAtAllWidths) {
    Interval gain, fresnel_error;
    for (int i = 0; i <= 400; ++i) {
        const double alpha = alpha_of(i / 400.0);
        const FitMeans fitted = integrate_fit(alpha);
        const LayerAlbedo mean = evaluate_mean_layer_albedo(float(alpha));
        // What a white mirror reflects too much, from where the second lobe is brightest.
        gain.add(fitted.greatest_loss * (fitted.loss / mean.loss - 1.0));
        fresnel_error.add(mean.fresnel - fitted.fresnel);
    }
    std::printf("furnace: %.5f to %.5f; B: %.5f to %.5f\n", gain.least, gain.greatest, fresnel_error.least,
                fresnel_error.greatest);
    EXPECT_LT(gain.greatest, MOST_BELOW);
    EXPECT_GT(gain.least, -4.0 * MOST_BELOW);
    EXPECT_LT(std::max(-fresnel_error.least, fresnel_error.greatest), MOST_BELOW);
}

// A bound on the error of the base and the second lobe that errors of the albedos cause, 1/sr.
double propagate_error(const SurfaceMaterial& m, const OracleAlbedos& of) {
    const auto let_through = [&](const OracleAlbedo& a) {
        return 1.0 - m.f0.x * (a.whole - a.grazing) - m.f90 * a.grazing;
    };
    const double error = MOST_ABOVE_AT_GRAZING + QUADRATURE_ERROR;
    const double v = let_through(of.view), l = let_through(of.light), mean = let_through(of.mean);
    const double base = m.diffuse_albedo.x * (error * (v + l + error) / mean + v * l * error / (mean * mean));
    const double lost_v = 1.0 - of.view.whole, lost_l = 1.0 - of.light.whole, lost = 1.0 - of.mean.whole;
    const double multiple =
        error * (lost_v + lost_l + error) / lost + lost_v * lost_l * error / (lost * lost);
    return (base + multiple) / M_PI;
}

TEST(LayerAlbedo, TheBrdfEqualsItsTwinWithAlbedosByQuadrature) {
    Draws draws(1);
    for (const double alpha : {0.1, 0.3, 0.6, 1.0}) {
        const LayerOracle layer(alpha, 4000);
        for (int i = 0; i < 2000; ++i) {
            const double f0 = draws.uniform(0.0, 0.9), f90 = draws.uniform(f0, 1.0);
            const SurfaceMaterial m = make_material(draws.uniform(), f0, f90, alpha);
            const vec3 v = sample_cosine_hemisphere(draws.uniform_vec2());
            const vec3 l = sample_cosine_hemisphere(draws.uniform_vec2());
            if (v.z < 0.02f || l.z < 0.02f) continue;
            const dvec3 view = glm::normalize(dvec3(v)), light = glm::normalize(dvec3(l));
            const OracleAlbedos albedos = layer.albedos(view, light);
            const double expected =
                oracle_brdf(m.diffuse_albedo.x, m.f0.x, m.f90, m.alpha, view, light, albedos);
            ASSERT_NEAR(shipped_brdf(m, v, l), expected, propagate_error(m, albedos) + 1e-4 * expected)
                << alpha;
        }
    }
}

}  // namespace
}  // namespace tarn
