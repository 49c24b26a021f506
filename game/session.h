// What viewer and sandbox begin with, and where their screenshots go.
#pragma once

#include <filesystem>
#include <string>

#include "tarn_names.h"
#include "window.h"

namespace game {

// An engine that draws in the window's context, or in one of its own where there is no window. Error where
// its OpenGL does not do. `threads` as for EngineOptions.
Engine open_engine(const Window* window, int threads);

// A picture that is not there yet, out/STEM_0001.ENDING and so on; makes the folder. Error that names it
// where that fails.
std::filesystem::path find_new_picture(const std::string& stem, const std::string& ending = "png");

}  // namespace game
