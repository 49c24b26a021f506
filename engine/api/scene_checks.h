// What edits of a public scene have in common: finding nodes, checking numbers, noting what has changed.
#pragma once

#include "api/scene_state.h"
#include "tarn/error.h"

namespace tarn::api {

bool is_finite(const Vec3& v);

// Error where there is no such node.
tarn::Node& find_node_of(SceneState& state, Node node);

// Error for numbers that are not finite, and for a rotation of length 0.
tarn::Transform checked_transform(const Transform& transform);

// An edit that may have changed anything but meshes and materials' number.
void note_edit(SceneState& state);
// An edit after which there are other meshes, instances or materials.
void note_rebuild(SceneState& state);

}  // namespace tarn::api
