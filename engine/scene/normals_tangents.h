// What a file may leave out of a mesh: normals and tangents.
#pragma once

#include "scene/scene.h"

namespace tarn {

// Gives each triangle vertices of its own with its geometric normal, as glTF asks where normals are missing.
// Morph targets get the change of that normal. Triangles without area get +Z. Drops tangents.
void add_flat_normals(Mesh& mesh);

// Scales normals to length 1; those of length 0 become the mean of their triangles' normals, or +Z.
void normalize_normals(Mesh& mesh);

// Tangents by the definition of MikkTSpace (Mikkelsen 2008, "Simulation of wrinkled surfaces revisited"),
// from uv0 or uv1: at each vertex the angle-weighted mean over the triangles that are connected there by
// edges and whose uv have the same handedness. Splits vertices where that gives more than one. Without
// texture coordinates, any direction perpendicular to the normal. w = +1 where (tangent, cross(normal,
// tangent)) is (+u, -v), which is up in a glTF texture.
void add_tangents(Mesh& mesh, int uv_set);

}  // namespace tarn
