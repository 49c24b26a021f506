// glTF 2.0 (.gltf, .glb, data URIs) into scene tables.
#pragma once

#include <filesystem>

#include "scene/scene.h"

namespace tarn {

struct GltfOptions {
    int scene_index =
        -1;  // -1: the file's default scene, else its first; a file without scenes shows all root nodes
};

// Loads and checks a whole file; what comes back is safe to index without further checks. Throws Error with
// one line that names the file and what is wrong with it. Warns once about each optional extension that is
// ignored.
Scene load_gltf(const std::filesystem::path& path, const GltfOptions& options = {});

}  // namespace tarn
