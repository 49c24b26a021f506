// What is written over the sandbox's picture: a cross, the count of lanterns, help, and a panel for
// engineers.
#pragma once

#include <string>
#include <vector>

#include "../play/simulation.h"
#include "../recent_timings.h"
#include "../tarn_names.h"
#include "help.h"

namespace game {

// What the panel changes.
struct SandboxSettings {
    Settings settings;
    std::string preset;  // that was last chosen
    float glare_strength = 1.0f;
    int fireflies = 0;      // that shine
    float frame_ms = 0.0f;  // what a frame may take; 0: as long as it does
};

struct SandboxFacts {
    bool shows_help = false;
    std::vector<HelpLine> help;
    bool shows_panel = false;
    bool has_mouse = false;  // else play waits
    std::string message;     // the last screenshot or error
    int width_px = 0;
    int height_px = 0;
    double frames_per_s = 0.0;
    int rung = 0;  // of the governor's ladder, of so many
    int rungs = 1;
    std::string rung_sentence;
    double step_ms = 0.0;  // of the simulation, in the last frame: of all its steps
    FrameReport report;
    FrameCost cost;
};

// Describes all of it to Dear ImGui; call between Widgets::begin() and end().
void draw_sandbox_panel(SandboxSettings& settings, const SandboxFacts& facts, const PlayState& state);

}  // namespace game
