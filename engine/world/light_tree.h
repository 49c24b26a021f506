// The tree by which a light can be drawn for a point (shaders/shared/math/light_tree.h): built, and fitted
// again where lights moved.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "world/light_bounds.h"
#include "world/lights.h"

namespace tarn {

struct World;

struct LightTree {
    std::vector<glm::uvec4> rows;  // nodes, header, directional lights, trails
    std::uint32_t node_count = 0;  // the header among them; 0: there is nothing to draw

    // Rows that the latest update_light_tree wrote: ascending ranges, all where `structure_revision` grew.
    std::vector<IndexRange> changed;
    std::uint64_t structure_revision = 0;  // grows when the tree is built, not when it is fitted
    std::uint64_t revision = 0;            // grows with any change

    // For fitting: about 150 bytes a light.
    std::vector<LightBounds> bounds;     // by node
    std::vector<std::uint32_t> parents;  // by pair of siblings
    std::vector<std::uint32_t> leaves;   // by light: its node, or INVALID_INDEX where it is not in the tree
    std::uint64_t order_revision = 0;    // of the lights, as this tree knows them
    std::uint64_t lights_revision = 0;
};

// Brings World::light_tree up to date: builds it where lights came or went since the last call, else fits the
// bounds of what moved (the order stays that of the older places, so that far moves cost quality, never
// correctness). To be called after update_world by whoever draws from the tree. All lights of positive power
// are in the tree but for directional ones, which have a list of their own. All threads.
void update_light_tree(World& world);

}  // namespace tarn
