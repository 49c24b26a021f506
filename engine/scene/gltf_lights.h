// KHR_lights_punctual into the scene's tables.
#pragma once

#include <vector>

#include "scene/gltf_document.h"
#include "scene/scene.h"

namespace tarn {

// Appends all lights of the file, in its order, and lists the shown nodes that carry one.
// Throws Error for an unknown kind.
void add_lights(const GltfDocument& document, const std::vector<bool>& is_shown, Scene& scene);

}  // namespace tarn
