// What this scene needs: the shader variants and passes that run, and why. What a scene lacks costs nothing.
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

FramePlan make_plan(const World& world);

}  // namespace tarn
