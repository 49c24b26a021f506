#include "world/light_tree_builder.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

namespace tarn {
namespace {

constexpr std::size_t BIN_COUNT = 12;
constexpr std::size_t LEAST_BIN_COUNT = 4;  // for few lights, of which there are most
// A dimension is dearer, the shorter it is; one so much shorter than the longest is not looked at.
constexpr float LEAST_EXTENT = 0.2f;

// Lights of a slab, or of several side by side. How far their normals are apart is judged by the length of
// their mean: (1 + cos) / 2 for normals that fill a cone evenly. It decides where to divide, no more; bounds
// are found afterwards.
struct Group {
    glm::vec3 lower{1e30f};
    glm::vec3 upper{-1e30f};
    glm::vec3 normal_sum{0.0f};
    float normals_rad = 0.0f;
    float emission_rad = 0.0f;
    float intensity = 0.0f;
    std::uint32_t count = 0;

    void add(const LightBounds& light) {
        lower = glm::min(lower, light.lower);
        upper = glm::max(upper, light.upper);
        normal_sum += light.axis;
        normals_rad = std::max(normals_rad, light.normals_rad);
        emission_rad = std::max(emission_rad, light.emission_rad);
        intensity += light.intensity;
        ++count;
    }
    void add(const Group& other) {
        lower = glm::min(lower, other.lower);
        upper = glm::max(upper, other.upper);
        normal_sum += other.normal_sum;
        normals_rad = std::max(normals_rad, other.normals_rad);
        emission_rad = std::max(emission_rad, other.emission_rad);
        intensity += other.intensity;
        count += other.count;
    }

    // Intensity x area x orientation. `padding` keeps lights in a row or at one place from costing nothing.
    float compute_cost(float padding) const {
        const glm::vec3 e = upper - lower + padding;
        const float mean_length = glm::length(normal_sum) / float(count);
        const float spread_rad = std::acos(std::clamp(2.0f * mean_length - 1.0f, -1.0f, 1.0f));
        return intensity * (e.x * e.y + e.y * e.z + e.z * e.x) *
               measure_orientation(std::min(normals_rad + spread_rad, PI), emission_rad);
    }
};

using Bins = std::array<Group, BIN_COUNT>;

struct Split {
    int dimension = -1;   // -1: none
    std::size_t bin = 0;  // the last one that goes left
    float cost = 1e38f;
};

// Maps centres to bins.
struct Slabs {
    glm::vec3 lower{1e30f};
    glm::vec3 upper{-1e30f};
    glm::vec3 scale{0.0f};
    std::size_t count = BIN_COUNT;

    std::size_t bin(const LightBounds& light, int dimension) const {
        const float place = (light.centre()[dimension] - lower[dimension]) * scale[dimension];
        return std::min(count - 1, std::size_t(std::max(place, 0.0f)));
    }
};

Slabs find_slabs(const BoundedLight* lights, std::size_t count) {
    Slabs slabs;
    for (std::size_t i = 0; i < count; ++i) {
        const glm::vec3 centre = lights[i].bounds.centre();
        slabs.lower = glm::min(slabs.lower, centre);
        slabs.upper = glm::max(slabs.upper, centre);
    }
    slabs.count = std::clamp(count / 2, LEAST_BIN_COUNT, BIN_COUNT);
    for (int d = 0; d < 3; ++d) {
        const float extent = slabs.upper[d] - slabs.lower[d];
        slabs.scale[d] = extent > 0.0f ? float(slabs.count) / extent : 0.0f;
    }
    return slabs;
}

// All dimensions at once: three sums side by side hide each other's latency.
void fill_bins(const BoundedLight* lights, std::size_t count, const Slabs& slabs, std::array<Bins, 3>& bins) {
    for (Bins& row : bins) std::fill_n(row.begin(), slabs.count, Group{});
    for (std::size_t i = 0; i < count; ++i) {
        for (int d = 0; d < 3; ++d) {
            bins[std::size_t(d)][slabs.bin(lights[i].bounds, d)].add(lights[i].bounds);
        }
    }
}

// The cheapest place to divide along one dimension, if it is cheaper than `best`.
void improve_split(const Bins& bins, std::size_t bin_count, int dimension, float stretch, float padding,
                   Split& best) {
    std::array<float, BIN_COUNT> right_costs{};
    Group left, right;
    for (std::size_t b = bin_count - 1; b > 0; --b) {
        right.add(bins[b]);
        if (right.count > 0) right_costs[b] = right.compute_cost(padding);
    }
    const std::uint32_t total = right.count + bins[0].count;
    for (std::size_t b = 0; b + 1 < bin_count; ++b) {
        left.add(bins[b]);
        if (bins[b].count == 0 || left.count == total) continue;
        const float cost = stretch * (left.compute_cost(padding) + right_costs[b + 1]);
        if (cost < best.cost) best = {dimension, b, cost};
    }
}

// Long thin groups are bad for either side: a dimension is dearer, the shorter it is.
Split find_split(const BoundedLight* lights, std::size_t count, const Slabs& slabs) {
    std::array<Bins, 3> bins;
    fill_bins(lights, count, slabs, bins);
    const glm::vec3 extent = slabs.upper - slabs.lower;
    const float longest = max_component(extent);
    Split best;
    for (int d = 0; d < 3; ++d) {
        if (!(extent[d] > LEAST_EXTENT * longest) || !is_finite(slabs.scale[d])) continue;
        improve_split(bins[std::size_t(d)], slabs.count, d, longest / extent[d], 1e-3f * longest, best);
    }
    return best;
}

std::size_t divide_in_middle(BoundedLight* lights, std::size_t count, const Slabs& slabs) {
    const glm::vec3 extent = slabs.upper - slabs.lower;
    const int d = extent.x >= extent.y && extent.x >= extent.z ? 0 : extent.y >= extent.z ? 1 : 2;
    std::nth_element(lights, lights + count / 2, lights + count, [d](const auto& a, const auto& b) {
        const float x = a.bounds.centre()[d], y = b.bounds.centre()[d];
        return x != y ? x < y : a.light < b.light;
    });
    return count / 2;
}

}  // namespace

std::size_t divide_lights(BoundedLight* lights, std::size_t count, std::uint32_t max_levels) {
    if (count == 2) return 1;
    const Slabs slabs = find_slabs(lights, count);
    // Levels that the larger part of the worst division would need, and the level of the division itself.
    const std::uint32_t needed = std::uint32_t(std::bit_width(count - 2)) + 1;
    if (needed > max_levels) return divide_in_middle(lights, count, slabs);
    const Split split = find_split(lights, count, slabs);
    if (split.dimension < 0) return divide_in_middle(lights, count, slabs);
    const BoundedLight* middle = std::partition(lights, lights + count, [&](const BoundedLight& light) {
        return slabs.bin(light.bounds, split.dimension) <= split.bin;
    });
    return std::size_t(middle - lights);
}

}  // namespace tarn
