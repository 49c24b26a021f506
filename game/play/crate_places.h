// Where crates are to stand in a level.
#pragma once

#include <string>
#include <vector>

#include "level.h"

namespace game {

// In lantern_court a dozen, where nothing else stands; elsewhere a small stack ahead of the start. The
// simulation leaves out those without room.
std::vector<CratePlace> find_crate_places(const std::string& scene_name, const Level& level);

}  // namespace game
