// Plays a replay: the same pictures in a window and without one.
#pragma once

#include <filesystem>
#include <functional>

#include "../play/replay_file.h"
#include "../window.h"
#include "stage.h"

namespace game {

struct ReplayOptions {
    std::filesystem::path file;    // for messages
    std::filesystem::path folder;  // where frame_000000.png and so on go; empty: nowhere
    int every = 1;                 // steps a frame
    int threads = 0;               // as for EngineOptions
    bool prints_times = false;     // one line on stdout, at the end
    std::function<bool()> stop;    // asked before each frame; true: end. Empty: never
};

// The replay's settings. Error that names the file, and the setting that is not known or out of range.
StageLook make_look(const Replay& replay, const std::filesystem::path& file);

// Frame k shows the stage after k * `every` steps; frame 0 the start. `window` null: without one. Error where
// the level is not the one that the replay was recorded in, and where the play ends in another state than it
// did then; one line on stderr where the replay is cut off, and does not know.
void play_replay(Stage& stage, const Replay& replay, const ReplayOptions& options, Window* window);

}  // namespace game
