// The BRDF once more, in double precision and from the papers' formulas, and quadrature over the hemisphere.
#pragma once

#include <cmath>
#include <glm/glm.hpp>

#include "shared/math/brdf.h"

namespace tarn::test {

using glm::dvec2;
using glm::dvec3;

inline double schlick(double f0, double f90, double cosine) {
    return f0 + (f90 - f0) * std::pow(1.0 - cosine, 5.0);
}

// GGX from the angle between half vector and normal (Walter et al. 2007, equation 33).
inline double ggx(double cos_h, double alpha) {
    const double tan2 = (1.0 - cos_h * cos_h) / (cos_h * cos_h);
    const double root = alpha * alpha + tan2;
    return alpha * alpha / (M_PI * std::pow(cos_h, 4.0) * root * root);
}

// Smith's Lambda (Heitz 2014, equation 72).
inline double smith_lambda(double cosine, double alpha) {
    const double tan2 = (1.0 - cosine * cosine) / (cosine * cosine);
    return 0.5 * (std::sqrt(1.0 + alpha * alpha * tan2) - 1.0);
}

// Single scattering of the layer in 1/sr, were its Fresnel term 1: D G2 / (4 n.v n.l).
inline double oracle_facets(double alpha, const dvec3& v, const dvec3& l) {
    const dvec3 h = glm::normalize(v + l);
    const double g2 = 1.0 / (1.0 + smith_lambda(v.z, alpha) + smith_lambda(l.z, alpha));
    return ggx(h.z, alpha) * g2 / (4.0 * v.z * l.z);
}

// How much of the light from a direction, or on average, the layer reflects by single scattering: E were its
// Fresnel term 1, and B were it (1 - v.h)^5.
struct OracleAlbedo {
    double whole = 1.0;    // E
    double grazing = 0.0;  // B
};

// The albedos that the BRDF at one pair of directions depends on.
struct OracleAlbedos {
    OracleAlbedo view, light, mean;
};

// Classic mistakes in keeping the energy, to be planted.
enum class EnergyMistake {
    NONE,
    FORGET_MULTIPLE_SCATTERING,
    UNCOUPLED_BASE,
    MULTIPLE_SCATTERING_WITHOUT_MEAN,
    BASE_WITHOUT_MEAN,
    VIEW_FOR_LIGHT,
};

// Reflectance of one channel, 1/sr, for view and light above the surface: the layer of Kulla and Conty (2017)
// over the base of Kelemen and Szirmay-Kalos (2001).
inline double oracle_brdf(double albedo, double f0, double f90, double alpha, const dvec3& v, const dvec3& l,
                          OracleAlbedos of, EnergyMistake mistake = EnergyMistake::NONE) {
    if (mistake == EnergyMistake::VIEW_FOR_LIGHT) of.light = of.view;
    const double mean_schlick = f0 * 20.0 / 21.0 + f90 / 21.0;
    double multiple_fresnel =
        mean_schlick * mean_schlick * of.mean.whole / (1.0 - mean_schlick * (1.0 - of.mean.whole));
    if (mistake == EnergyMistake::FORGET_MULTIPLE_SCATTERING) multiple_fresnel = 0.0;
    const auto reflect = [&](const OracleAlbedo& a) {
        return f0 * (a.whole - a.grazing) + f90 * a.grazing + multiple_fresnel * (1.0 - a.whole);
    };
    double multiple = multiple_fresnel * (1.0 - of.view.whole) * (1.0 - of.light.whole) / M_PI;
    if (mistake != EnergyMistake::MULTIPLE_SCATTERING_WITHOUT_MEAN) multiple /= 1.0 - of.mean.whole;
    double base = (1.0 - reflect(of.view)) * (1.0 - reflect(of.light)) / M_PI;
    // A layer that reflects everything has no base: 0 / 0.
    if (mistake != EnergyMistake::BASE_WITHOUT_MEAN) base /= std::max(1.0 - reflect(of.mean), 1e-9);
    if (mistake == EnergyMistake::UNCOUPLED_BASE) base = 1.0 / M_PI;
    const double cos_h = glm::dot(v, glm::normalize(v + l));
    return albedo * base + multiple + schlick(f0, f90, cos_h) * oracle_facets(alpha, v, l);
}

// Solid-angle density of a reflection about visible normals (Heitz 2018).
inline double oracle_layer_pdf(double alpha, const dvec3& v, const dvec3& l) {
    const dvec3 h = glm::normalize(v + l);
    const double g1 = 1.0 / (1.0 + smith_lambda(v.z, alpha));
    return g1 * ggx(h.z, alpha) / (4.0 * v.z);
}

inline dvec3 reflect_about(const dvec3& v, const dvec3& h) {
    return h * (2.0 * glm::dot(v, h)) - v;
}

// Half vectors by (s, azimuth) in the unit square, (1 - s)^2 = alpha^2 / (alpha^2 + tan^2): resolves a
// highlight of any width, and densities of reflected directions stay bounded up to s = 1, where half vectors
// graze.
inline dvec3 half_vector_at(const dvec2& u, double alpha) {
    const double rest = 1.0 - u.x;
    const double tangent = alpha * std::sqrt(1.0 - rest * rest) / rest;
    const double cosine = 1.0 / std::sqrt(1.0 + tangent * tangent);
    const double phi = 2.0 * M_PI * u.y;
    return dvec3(cosine * tangent * std::cos(phi), cosine * tangent * std::sin(phi), cosine);
}

// Solid angle of half vectors per area of the unit square at `u`.
inline double half_vector_jacobian(const dvec2& u, double alpha) {
    const double cosine = half_vector_at(u, alpha).z;
    return 2.0 * M_PI * std::pow(cosine / (1.0 - u.x), 3.0) * alpha * alpha;
}

// The inverse of half_vector_at.
inline dvec2 half_vector_square(const dvec3& h, double alpha) {
    const double tan2 = (h.x * h.x + h.y * h.y) / (h.z * h.z);
    const double turn = std::atan2(h.y, h.x) / (2.0 * M_PI);
    return dvec2(1.0 - alpha / std::sqrt(alpha * alpha + tan2), turn < 0.0 ? turn + 1.0 : turn);
}

// Integral of f(light) over the upper hemisphere, on two lattices of `point_count` points at once, one that
// follows the cosine and one that follows a GGX highlight of width `alpha`; the balance heuristic joins them.
// The lattice turns by the golden ratio from point to point, so that both of its coordinates are resolved
// finely.
template <class F>
double integrate_hemisphere(const F& f, const dvec3& view, double alpha, int point_count) {
    const auto weighted = [&](const dvec3& l, const dvec3& h) {
        if (l.z <= 0.0) return 0.0;
        const dvec2 square = half_vector_square(h, alpha);
        const double highlight_pdf = 1.0 / (4.0 * glm::dot(view, h) * half_vector_jacobian(square, alpha));
        return f(l) / (l.z / M_PI + highlight_pdf);
    };
    double sum = 0.0;
    for (int i = 0; i < point_count; ++i) {
        const dvec2 u((i + 0.5) / point_count, std::fmod(i * 0.6180339887498949, 1.0));
        const double phi = 2.0 * M_PI * u.y;
        const dvec3 l(std::sqrt(u.x) * std::cos(phi), std::sqrt(u.x) * std::sin(phi), std::sqrt(1.0 - u.x));
        sum += weighted(l, glm::normalize(view + l));
        const dvec3 h = half_vector_at(u, alpha);
        if (glm::dot(view, h) > 0.0) sum += weighted(reflect_about(view, h), h);
    }
    return sum / point_count;
}

// The albedos by which the shipped BRDF keeps its energy, for twins that must equal it to rounding. What
// these fits are worth is the matter of tests/unit/layer_albedo.cpp.
inline OracleAlbedos shipped_albedos(double alpha, const dvec3& v, const dvec3& l) {
    const LayerFit fit = fit_layer(float(alpha));
    const auto convert = [](const LayerAlbedo& a) { return OracleAlbedo{1.0 - a.loss, a.fresnel}; };
    return {convert(evaluate_layer_albedo(fit, float(v.z))), convert(evaluate_layer_albedo(fit, float(l.z))),
            convert(evaluate_mean_layer_albedo(float(alpha)))};
}

// Unit view direction at `angle_deg` from the normal.
inline dvec3 view_at(double angle_deg) {
    const double angle = angle_deg * M_PI / 180.0;
    return dvec3(std::sin(angle) * 0.8, std::sin(angle) * 0.6, std::cos(angle));
}

}  // namespace tarn::test
