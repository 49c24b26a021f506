// The BRDF once more, in double precision and from the textbook formulas, and quadrature over the hemisphere.
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

// Reflectance of one channel, 1/sr, for view and light above the surface.
inline double oracle_brdf(double albedo, double f0, double f90, double alpha, const dvec3& v,
                          const dvec3& l) {
    const dvec3 h = glm::normalize(v + l);
    const double g2 = 1.0 / (1.0 + smith_lambda(v.z, alpha) + smith_lambda(l.z, alpha));
    const double layer = schlick(f0, f90, glm::dot(v, h)) * ggx(h.z, alpha) * g2 / (4.0 * v.z * l.z);
    return albedo / M_PI * (1.0 - schlick(f0, f90, v.z)) * (1.0 - schlick(f0, f90, l.z)) + layer;
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

// Unit view direction at `angle_deg` from the normal.
inline dvec3 view_at(double angle_deg) {
    const double angle = angle_deg * M_PI / 180.0;
    return dvec3(std::sin(angle) * 0.8, std::sin(angle) * 0.6, std::cos(angle));
}

}  // namespace tarn::test
