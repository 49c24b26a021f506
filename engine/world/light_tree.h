// The tree by which a light can be drawn for a point (shaders/shared/math/light_tree.h): built, and fitted
// again where lights moved.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "world/change_log.h"
#include "world/light_bounds.h"
#include "world/lights.h"

namespace tarn {

// Belongs to who draws from it, not to the world.
struct LightTree {
    std::vector<glm::uvec4> rows;  // nodes, header, directional lights, trails
    std::uint32_t node_count = 0;  // the header among them; 0: there is nothing to draw

    ChangeLog changes;                     // of rows; everything where the tree was built
    std::uint64_t structure_revision = 0;  // grows when the tree is built, not when it is fitted

    // For fitting: about 150 bytes a light.
    std::vector<LightBounds> bounds;     // by node
    std::vector<std::uint32_t> parents;  // by pair of siblings
    std::vector<std::uint32_t> leaves;   // by light: its node, or INVALID_INDEX where it is not in the tree
    std::uint64_t order_revision = 0;    // of the lights, as this tree knows them
    ChangeLog::Cursor lights_seen;
};

// Brings the tree up to date with the lights, those of one world from call to call: builds it where lights
// came or went since the last call, else fits the bounds of what moved (the order stays that of the older
// places, so that far moves cost quality, never correctness). However many updates of the lights lie between
// two calls, the second comes to the bits that a call after each of them would come to, but for the order,
// which is that of the moment when the tree was built. All lights of positive power are in the tree but for
// directional ones, which have a list of their own. All threads.
void update_light_tree(LightTree& tree, const WorldLights& lights);

}  // namespace tarn
