// Tracks of a flythrough as an animation of the scene that it flies through.
#pragma once

#include <span>

#include "scene/camera_path.h"
#include "scene/scene.h"

namespace tarn {

// Adds one animation that plays `tracks` once: positions along a Catmull-Rom curve, rotations by spherical
// interpolation, both held before the first key and after the last. Before build_world, which wants to know
// what moves. Throws Error where a node does not exist, has a name that others have too, or is placed by a
// matrix; the scene is then as it was.
void add_tracks(Scene& scene, std::span<const NodeTrack> tracks);

}  // namespace tarn
