// What this scene needs: the shader variants and passes that run, and why. What a scene does not have costs
// nothing.
#pragma once

#include <string>
#include <vector>

#include "world/world.h"

namespace tarn {

struct PlanEntry {
    std::string define;  // shader define
    std::string reason;  // "7 texture slots in use"
};

struct FramePlan {
    std::vector<PlanEntry> entries;

    // The defines alone, as ProgramLibrary takes them.
    std::vector<std::string> defines() const;
};

// What may differ from the last frame: shaders that look back tell the two frames apart only where they must.
struct PlanHistory {
    bool surfaces_move = false;
    bool lights_change = false;

    bool operator==(const PlanHistory&) const = default;
};

FramePlan make_plan(const World& world, const PlanHistory& history = {});

}  // namespace tarn
