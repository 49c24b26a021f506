// Images of a glTF file into linear 16-bit texels.
#pragma once

#include <optional>

#include "scene/gltf_document.h"
#include "scene/scene.h"

namespace tarn {

enum class TexelEncoding { LINEAR, SRGB };

// Reads and decodes images[index] (PNG or JPEG) to RGBA; SRGB: red, green and blue are decoded to linear.
// Nothing, and a warning, where the picture is missing or of a format that only extensions know: KTX, WebP,
// DDS. Throws Error for any other format, broken data, or a size that the data cannot hold.
std::optional<TextureImage> load_gltf_image(GltfDocument& document, int index, TexelEncoding encoding);

}  // namespace tarn
