// Albedos of the GGX layer by quadrature in double precision, as a table over the cosine.
#pragma once

#include <vector>

#include "support/brdf_oracle.h"

namespace tarn::test {

// E and B at one cosine, by quadrature of the textbook formulas over the hemisphere of lights.
inline OracleAlbedo integrate_layer(double alpha, double cosine, int point_count) {
    const dvec3 v(std::sqrt(1.0 - cosine * cosine), 0.0, cosine);
    const auto weigh = [&](double f0, double f90) {
        return integrate_hemisphere(
            [&](const dvec3& l) {
                const double cos_h = glm::dot(v, glm::normalize(v + l));
                return schlick(f0, f90, cos_h) * oracle_facets(alpha, v, l) * l.z;
            },
            v, alpha, point_count);
    };
    return {weigh(1.0, 1.0), weigh(0.0, 1.0)};
}

// All albedos of one width: computed once, then looked up. The nodes crowd towards grazing angles, where
// albedos change fastest: cosine = t^3, t even. Linear between them: an error of about 2e-4.
class LayerOracle {
  public:
    static constexpr int NODES = 160;

    explicit LayerOracle(double alpha, int point_count = 10'000) {
        mean_ = {0.0, 0.0};
        for (int i = 0; i <= NODES; ++i) {
            const double t = double(i) / NODES;
            // At exactly 90 degrees the formulas are 0 / 0.
            nodes_.push_back(integrate_layer(alpha, std::max(t * t * t, 1e-5), point_count));
            // 2 cosine dcosine, by the trapezoidal rule.
            const double weight = 6.0 * std::pow(t, 5.0) / NODES * (i == NODES ? 0.5 : 1.0);
            mean_.whole += weight * nodes_.back().whole;
            mean_.grazing += weight * nodes_.back().grazing;
        }
    }

    OracleAlbedo at(double cosine) const {
        const double t = std::cbrt(cosine) * NODES;
        const int i = std::min(int(t), NODES - 1);
        const OracleAlbedo &a = nodes_[i], &b = nodes_[i + 1];
        return {glm::mix(a.whole, b.whole, t - i), glm::mix(a.grazing, b.grazing, t - i)};
    }

    // Over all directions, weighed with the cosine.
    const OracleAlbedo& mean() const { return mean_; }

    OracleAlbedos albedos(const dvec3& v, const dvec3& l) const { return {at(v.z), at(l.z), mean_}; }

  private:
    std::vector<OracleAlbedo> nodes_;
    OracleAlbedo mean_;
};

}  // namespace tarn::test
