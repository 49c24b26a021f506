// glTF materials and textures into the scene's tables.
#pragma once

#include <vector>

#include "scene/gltf_document.h"
#include "scene/scene.h"

namespace tarn {

// Appends all materials of the file, in its order, then glTF's default material. Factors and texture
// placements only: `add_textures` fills the texture indices.
void add_materials(GltfDocument& document, Scene& scene);

// Makes the textures and images that materials with is_used[i] need, decodes them and points the materials'
// slots at them. Base colour and emission decode sRGB; an image used both ways is made twice. Throws Error
// for an image that is missing or broken.
void add_textures(GltfDocument& document, const std::vector<bool>& is_used, Scene& scene);

}  // namespace tarn
