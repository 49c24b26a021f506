// glTF nodes, instances, cameras and skins.
#pragma once

#include <vector>

#include "scene/gltf_document.h"
#include "scene/scene.h"

namespace tarn {

// Appends all nodes of the file, in its order, with their parents and transforms.
void add_nodes(GltfDocument& document, Scene& scene);

// is_shown[i]: node i belongs to the tree of scene `scene_index` (-1: the default one, else the first, else
// all). Throws Error where there is no such scene. Names `scene` after it.
std::vector<bool> find_shown_nodes(const GltfDocument& document, int scene_index, Scene& scene);

void add_skins(GltfDocument& document, Scene& scene);

// One instance for each shown node and mesh of its glTF mesh. Checks skins and morph weights against the
// meshes.
void add_instances(GltfDocument& document, const std::vector<bool>& is_shown,
                   const std::vector<std::vector<MeshIndex>>& meshes, Scene& scene);

// One camera for each shown node that has one.
void add_cameras(const GltfDocument& document, const std::vector<bool>& is_shown, Scene& scene);

// Removes meshes that no instance shows.
void drop_unused_meshes(Scene& scene);

}  // namespace tarn
