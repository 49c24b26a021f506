// Images of a glTF file into linear 16-bit texels.
#pragma once

#include "scene/gltf_document.h"
#include "scene/scene.h"

namespace tarn {

enum class TexelEncoding { LINEAR, SRGB };

// Reads and decodes images[index] (PNG or JPEG) to RGBA; SRGB: red, green and blue are decoded to linear.
// Throws Error for a missing file, an unknown format, broken data, or a size that the data cannot hold.
TextureImage load_gltf_image(const GltfDocument& document, int index, TexelEncoding encoding);

}  // namespace tarn
