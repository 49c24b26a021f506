// glTF meshes into indexed triangle lists.
#pragma once

#include <vector>

#include "scene/gltf_document.h"
#include "scene/scene.h"

namespace tarn {

// Appends one Mesh for each primitive that has area, with normals, and tangents where its material has a
// normal map. Returns the meshes that each mesh of the file became, in the order of its primitives. Needs
// add_materials() before. Throws Error for indices out of range, attributes of unequal length and the like.
std::vector<std::vector<MeshIndex>> add_meshes(GltfDocument& document, Scene& scene);

// Targets of a mesh of the file; all its primitives have the same number.
std::size_t morph_target_count(const GltfDocument& document, int mesh);

}  // namespace tarn
