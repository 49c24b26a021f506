// What a stage is loaded from, and what becomes of it when somebody drops a file on the window.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "stage.h"

namespace game {

struct StageSource {
    std::string scene;                            // a .gltf or .glb file, or the name of one of Tarn's scenes
    std::filesystem::path sky;                    // an .hdr or .exr file; empty: the scene's own
    std::optional<int> fireflies = std::nullopt;  // as for Stage

    bool operator==(const StageSource&) const = default;
};

// Error that names the file, and what is wrong with it.
std::unique_ptr<Stage> load_stage(const StageSource& source);

// By the ending of the file: a scene takes the place of the one that is played in, a picture becomes its sky.
// Error for any other.
StageSource with_file(const StageSource& source, const std::filesystem::path& file);

}  // namespace game
