#include "core/near_names.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>
#include <vector>

namespace tarn {
namespace {

std::size_t count_differences(const std::string& a, const std::string& b) {
    std::vector<std::vector<std::size_t>> table(a.size() + 1, std::vector<std::size_t>(b.size() + 1));
    for (std::size_t i = 0; i <= a.size(); ++i) table[i][0] = i;
    for (std::size_t j = 0; j <= b.size(); ++j) table[0][j] = j;
    for (std::size_t i = 1; i <= a.size(); ++i) {
        for (std::size_t j = 1; j <= b.size(); ++j) {
            const std::size_t differs = a[i - 1] != b[j - 1] ? 1 : 0;
            std::size_t least = std::min(table[i - 1][j], table[i][j - 1]) + 1;
            least = std::min(least, table[i - 1][j - 1] + differs);
            const bool swapped = i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1];
            if (swapped) least = std::min(least, table[i - 2][j - 2] + 1);
            table[i][j] = least;
        }
    }
    return table[a.size()][b.size()];
}

}  // namespace

std::string suggest_names(const std::string& name, std::span<const std::string> names) {
    const std::size_t most = std::max<std::size_t>(1, name.size() / 3);
    std::vector<std::pair<std::size_t, std::string>> near;
    for (const std::string& candidate : names) {
        const std::size_t differences = count_differences(name, candidate);
        if (differences <= most) near.emplace_back(differences, fmt::format("'{}'", candidate));
    }
    std::sort(near.begin(), near.end());
    std::vector<std::string> texts;
    for (const auto& [differences, text] : near) texts.push_back(text);
    return texts.empty() ? "" : fmt::format("; did you mean {}?", fmt::join(texts, " or "));
}

}  // namespace tarn
