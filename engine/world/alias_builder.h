// Builds alias tables (Vose 1991) for draws in constant time; see shaders/shared/math/alias_table.h.
#pragma once

#include <glm/glm.hpp>
#include <span>
#include <vector>

namespace tarn {

struct AliasTable {
    std::vector<glm::uvec4> rows;  // packed AliasBucket, one a weight
    std::vector<float> pmf;        // weight / sum
};

// `weights` >= 0, any scale. Weights that are negative or not finite count as 0. Where all are 0 the table is
// uniform.
AliasTable build_alias_table(std::span<const double> weights);

}  // namespace tarn
