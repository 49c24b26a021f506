// glTF animations into the scene's channels.
#pragma once

#include "scene/gltf_document.h"
#include "scene/scene.h"

namespace tarn {

// Appends all animations of the file, in its order. Channels without a node or with an unknown target are
// left out. Throws Error for times that run backwards and for outputs that do not fit the times.
void add_animations(GltfDocument& document, Scene& scene);

}  // namespace tarn
