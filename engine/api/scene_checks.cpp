#include "api/scene_checks.h"

#include <cmath>

#include "api/guard.h"

namespace tarn::api {
namespace {

glm::dquat checked_rotation(const Rotation& rotation) {
    const glm::dquat q(rotation.w, rotation.x, rotation.y, rotation.z);
    const double length = glm::length(q);
    if (!(length > 0.0 && std::isfinite(length)))
        throw Error(fmt::format("a rotation is a quaternion of length {}", length));
    return q / length;
}

}  // namespace

bool is_finite(const Vec3& v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

tarn::Node& find_node_of(SceneState& state, Node node) {
    if (node.index >= state.scene.nodes.size())
        throw Error(fmt::format("node {}: the scene has {}", node.index, state.scene.nodes.size()));
    return state.scene.nodes[node.index];
}

tarn::Transform checked_transform(const Transform& transform) {
    if (!is_finite(transform.translation) || !is_finite(transform.scale))
        throw Error("a node's transform holds numbers that are not finite");
    return {from_public(transform.translation), checked_rotation(transform.rotation),
            from_public(transform.scale)};
}

void note_edit(SceneState& state) {
    ++state.scene.revision;
    state.is_stale = true;
}

void note_rebuild(SceneState& state) {
    note_edit(state);
    state.is_outgrown = true;
}

}  // namespace tarn::api
