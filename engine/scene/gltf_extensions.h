// Which glTF extensions Tarn reads.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string_view>

#include "scene/gltf_document.h"
#include "scene/scene.h"

namespace tarn {

// True for an extension that the import honours.
bool is_honoured_extension(std::string_view name);

// Throws Error naming every required extension that is not honoured. `root` need not have been checked.
void check_required_extensions(const nlohmann::json& root);

// Fills the scene's three lists of extensions and notes a warning for each ignored one.
void list_extensions(GltfDocument& document, Scene& scene);

}  // namespace tarn
