#include "metrics/seed_statistics.h"

#include <cmath>
#include <limits>
#include <vector>

#include "core/error.h"
#include "core/statistics.h"

namespace tarn {
namespace {

RunningMoments moments_of(std::span<const double> values) {
    RunningMoments moments;
    for (const double value : values) moments.add(value);
    return moments;
}

// Without spread a change is certain and no change is none.
double p_value_without_spread(double value) {
    return value == 0.0 ? 1.0 : 0.0;
}

}  // namespace

Estimate estimate_mean(std::span<const double> values) {
    const RunningMoments moments = moments_of(values);
    Estimate estimate{moments.mean(), moments.mean(), moments.mean()};
    if (moments.count() < 2) return estimate;
    const double reach =
        student_t_quantile(0.975, double(moments.count() - 1)) * std::sqrt(moments.variance_of_mean());
    estimate.low -= reach;
    estimate.high += reach;
    return estimate;
}

double fit_power_law(std::span<const double> x, std::span<const double> y) {
    TARN_ASSERT(x.size() == y.size(), "{} abscissas for {} ordinates", x.size(), y.size());
    std::vector<double> u, v;
    for (std::size_t i = 0; i < x.size(); ++i) {
        if (!(x[i] > 0.0 && y[i] > 0.0 && std::isfinite(x[i]) && std::isfinite(y[i]))) continue;
        u.push_back(std::log(x[i]));
        v.push_back(std::log(y[i]));
    }
    const double u_mean = moments_of(u).mean(), v_mean = moments_of(v).mean();
    double uu = 0.0, uv = 0.0;
    for (std::size_t i = 0; i < u.size(); ++i) {
        uu += (u[i] - u_mean) * (u[i] - u_mean);
        uv += (u[i] - u_mean) * (v[i] - v_mean);
    }
    return uu > 0.0 ? uv / uu : std::numeric_limits<double>::quiet_NaN();
}

Difference test_paired(std::span<const double> before, std::span<const double> after) {
    TARN_ASSERT(before.size() == after.size() && before.size() >= 2, "{} and {} paired values", before.size(),
                after.size());
    RunningMoments changes;
    for (std::size_t i = 0; i < before.size(); ++i) changes.add(after[i] - before[i]);
    const double error = std::sqrt(changes.variance_of_mean());
    if (error == 0.0) return {changes.mean(), p_value_without_spread(changes.mean())};
    return {changes.mean(), student_t_two_sided_p_value(changes.mean() / error, double(changes.count() - 1))};
}

Difference test_independent(std::span<const double> before, std::span<const double> after) {
    TARN_ASSERT(before.size() >= 2 && after.size() >= 2, "{} and {} values to compare", before.size(),
                after.size());
    const RunningMoments a = moments_of(before), b = moments_of(after);
    const double change = b.mean() - a.mean();
    const double va = a.variance_of_mean(), vb = b.variance_of_mean();
    if (va + vb == 0.0) return {change, p_value_without_spread(change)};
    // Welch and Satterthwaite's degrees of freedom.
    const double freedom =
        (va + vb) * (va + vb) / (va * va / double(a.count() - 1) + vb * vb / double(b.count() - 1));
    return {change, student_t_two_sided_p_value(change / std::sqrt(va + vb), freedom)};
}

}  // namespace tarn
