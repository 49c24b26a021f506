// The steps of build_world and update_world, in order. Private to this folder.
#pragma once

#include "world/world.h"

namespace tarn {

// geometry.cpp: meshes and vertices, then where the instances stand and the vertices of those that deform.
void add_meshes(World& world, const Scene& scene);
void place_instances(World& world, const Scene& scene, const Pose& pose);

// materials.cpp: texels and materials, then the factors of materials that were edited.
void add_materials(World& world, const Scene& scene);
void update_materials(World& world, const Scene& scene);

// lights.cpp: punctual lights and emissive triangles, with their table by power, all anew.
void rebuild_lights(World& world, const Scene& scene, const Pose& pose);

// lights_update.cpp: only what differs from the table, after edits of lights and materials.
void update_lights(World& world, const Scene& scene, const Pose& pose);
// The same where nothing but transforms has changed: of the nodes that the pose has touched.
void move_lights(World& world, const Scene& scene, const LivePose& pose);

// environment.cpp
WorldEnvironment make_environment(const Image& radiance);

}  // namespace tarn
