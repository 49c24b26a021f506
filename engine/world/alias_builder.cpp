#include "world/alias_builder.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "shared/math/alias_table.h"

namespace tarn {
namespace {

std::vector<double> normalized(std::span<const double> weights) {
    std::vector<double> result(weights.begin(), weights.end());
    double sum = 0.0;
    for (double& weight : result) {
        if (!std::isfinite(weight) || weight < 0.0) weight = 0.0;
        sum += weight;
    }
    for (double& weight : result) weight = sum > 0.0 ? weight / sum : 1.0 / double(result.size());
    return result;
}

// Random numbers have 24 bits, so a threshold between two of their values would be drawn as the next one. It
// is rounded up to the grid (a dim light keeps a chance), and the probabilities are those of the table as it
// is drawn from.
AliasTable pack_table(std::vector<double> threshold, const std::vector<std::uint32_t>& alias,
                      const std::vector<double>& weights) {
    constexpr double GRID = 16777216.0;
    const std::size_t count = threshold.size();
    std::vector<double> pmf(count, 0.0);
    for (std::size_t i = 0; i < count; ++i) {
        threshold[i] = weights[i] > 0.0 ? std::min(1.0, std::ceil(threshold[i] * GRID) / GRID) : 0.0;
        pmf[i] += threshold[i] / double(count);
        pmf[alias[i]] += (1.0 - threshold[i]) / double(count);
    }
    AliasTable table;
    table.rows.reserve(count);
    table.pmf.reserve(count);
    for (std::size_t i = 0; i < count; ++i) {
        AliasBucket bucket;
        bucket.threshold = float(threshold[i]);
        bucket.alias = alias[i];
        bucket.pmf_own = float(pmf[i]);
        bucket.pmf_alias = float(pmf[alias[i]]);
        table.rows.push_back(pack_alias_bucket(bucket));
        table.pmf.push_back(float(pmf[i]));
    }
    return table;
}

}  // namespace

AliasTable build_alias_table(std::span<const double> weights) {
    const std::vector<double> pmf = normalized(weights);
    const std::size_t count = pmf.size();
    std::vector<double> threshold(count);
    std::vector<std::uint32_t> alias(count);
    std::vector<std::uint32_t> small, large;
    for (std::size_t i = 0; i < count; ++i) {
        threshold[i] = pmf[i] * double(count);
        alias[i] = std::uint32_t(i);
        (threshold[i] < 1.0 ? small : large).push_back(std::uint32_t(i));
    }
    while (!small.empty() && !large.empty()) {
        const std::uint32_t poor = small.back(), rich = large.back();
        small.pop_back();
        alias[poor] = rich;
        threshold[rich] -= 1.0 - threshold[poor];
        if (threshold[rich] < 1.0) {
            large.pop_back();
            small.push_back(rich);
        }
    }
    // What is left is 1 up to rounding.
    for (const std::uint32_t i : small) threshold[i] = pmf[i] > 0.0 ? 1.0 : threshold[i];
    for (const std::uint32_t i : large) threshold[i] = 1.0;
    return pack_table(threshold, alias, pmf);
}

}  // namespace tarn
