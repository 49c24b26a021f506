// Meshes that a program makes at run time: spheres and boxes.
#pragma once

#include "scene/scene.h"

namespace tarn::api {

// Around the origin, of 20 * 4^subdivisions triangles: an icosahedron whose edges are halved so often, with
// the normals of the sphere.
Mesh make_sphere(double radius_m, int subdivisions);

// Around the origin, of 12 triangles with flat normals.
Mesh make_box(const glm::dvec3& half_extent_m);

}  // namespace tarn::api
