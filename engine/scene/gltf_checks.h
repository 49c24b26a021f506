// Checks across a parsed glTF document that no single property shows.
#pragma once

#include "scene/gltf_document.h"

namespace tarn {

// Buffer views within buffers, accessors within views, a node forest, skins, animations, lights, cameras.
// Throws Error naming the first thing that is wrong.
void check_gltf_document(const GltfDocument& document);

// Bytes from the start of one accessor element to the next, and the bytes of one element.
struct ElementLayout {
    std::size_t component_bytes = 0;
    std::size_t component_count = 0;
    std::size_t element_bytes = 0;  // matrix columns of small types start at multiples of 4 bytes
    std::size_t used_bytes = 0;     // element_bytes without padding at its end
};

// Throws Error for a component type or element type that glTF does not have.
ElementLayout layout_of(const tinygltf::Accessor& accessor, const std::string& name);

}  // namespace tarn
