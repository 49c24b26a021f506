// Rearranging the vertices of a mesh, all attributes together.
#pragma once

#include <cstdint>
#include <vector>

#include "scene/scene.h"

namespace tarn {

// Makes vertex v of the mesh what vertex sources[v] was: in all attributes and morph targets. Leaves
// triangles alone.
void remap_vertices(Mesh& mesh, const std::vector<std::uint32_t>& sources);

}  // namespace tarn
