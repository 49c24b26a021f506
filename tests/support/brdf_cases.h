// Materials and views that the tests of the BRDF share.
#pragma once

#include <functional>

#include "support/brdf_oracle.h"

namespace tarn::test {

inline constexpr double ALPHAS[] = {1e-3, 0.01, 0.1, 0.5, 1.0};
inline constexpr double VIEW_ANGLES_DEG[] = {0.0, 45.0, 80.0, 89.0, 89.99};

inline SurfaceMaterial make_material(double albedo, double f0, double f90, double alpha) {
    return {vec3(float(albedo)), vec3(float(f0)), float(f90), float(alpha)};
}

using Brdf = std::function<double(const SurfaceMaterial&, const vec3&, const vec3&)>;

inline double shipped_brdf(const SurfaceMaterial& m, const vec3& v, const vec3& l) {
    return evaluate_brdf(m, v, l).x;
}

// At 89.99 degrees, v + l of a highlight of width 1e-3 is a difference of numbers near 1: its rounding is a
// sixth of the highlight's width, so that neither side of the comparison is defined there.
inline bool is_resolved(double alpha, double angle_deg) {
    return alpha >= 0.01 || angle_deg < 89.9;
}

}  // namespace tarn::test
