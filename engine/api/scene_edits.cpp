// The public scene: nodes and lights, read and edited.
#include <algorithm>
#include <cmath>

#include "api/guard.h"
#include "api/scene_checks.h"

namespace tarn::api {
namespace {

PunctualLight& find_light(SceneState& state, Node node) {
    const tarn::Node& found = find_node_of(state, node);
    if (!found.light.is_set()) throw Error(fmt::format("node {} '{}' has no light", node.index, found.name));
    return at(state.scene.lights, found.light);
}

PunctualLight checked_light(const Light& light, std::string name) {
    constexpr double RIGHT_ANGLE = 1.5707963267948966;
    const Vec3& i = light.intensity;
    if (!is_finite(i) || i.x < 0.0 || i.y < 0.0 || i.z < 0.0)
        throw Error(fmt::format("a light's intensity is {}, {}, {}: it must be finite and not below 0", i.x,
                                i.y, i.z));
    if (!(light.inner_cone_rad >= 0.0 && light.inner_cone_rad <= light.outer_cone_rad &&
          light.outer_cone_rad <= RIGHT_ANGLE)) {
        throw Error(fmt::format("a light's cones are {} and {} rad: they must rise from 0 to pi / 2",
                                light.inner_cone_rad, light.outer_cone_rad));
    }
    if (!(light.range_m >= 0.0 && std::isfinite(light.range_m)))
        throw Error(fmt::format("a light's range is {} m: it must be finite and not below 0", light.range_m));
    return {std::move(name),      tarn::LightKind(light.kind), glm::vec3(from_public(i)),
            light.inner_cone_rad, light.outer_cone_rad,        light.range_m};
}

}  // namespace

std::size_t Scene::node_count() const {
    return state_->scene.nodes.size();
}

std::string Scene::node_name(Node node) const {
    return find_node_of(*state_, node).name;
}

Node Scene::find_node(const std::string& name) const {
    const std::vector<tarn::Node>& nodes = state_->scene.nodes;
    const auto found =
        std::find_if(nodes.begin(), nodes.end(), [&](const tarn::Node& node) { return node.name == name; });
    if (found == nodes.end()) throw Error(fmt::format("the scene has no node '{}'", name));
    return {std::uint32_t(found - nodes.begin())};
}

Transform Scene::transform(Node node) const {
    const tarn::Node& found = find_node_of(*state_, node);
    if (found.matrix) {
        throw Error(fmt::format("node {} '{}' is placed by a matrix, until a transform is set", node.index,
                                found.name));
    }
    const glm::dquat& q = found.local.rotation;
    return {to_public(found.local.translation), {q.x, q.y, q.z, q.w}, to_public(found.local.scale)};
}

void Scene::set_transform(Node node, const Transform& transform) {
    tarn::Node& found = find_node_of(*state_, node);
    found.local = checked_transform(transform);
    found.matrix.reset();
    state_->scene.moves.add(NodeIndex(node.index));
    state_->is_stale = true;
}

std::vector<Node> Scene::lights() const {
    std::vector<Node> list;
    for (const NodeIndex node : state_->scene.light_nodes) list.push_back({node.value});
    return list;
}

Light Scene::light(Node node) const {
    const PunctualLight& source = find_light(*state_, node);
    return {LightKind(source.kind), to_public(glm::dvec3(source.intensity)), source.inner_cone_rad,
            source.outer_cone_rad, source.range_m};
}

void Scene::set_light(Node node, const Light& light) {
    tarn::Scene& scene = state_->scene;
    PunctualLight edited = checked_light(light, find_light(*state_, node).name);
    tarn::Node& lit = find_node_of(*state_, node);
    const bool is_shared =
        std::count_if(scene.nodes.begin(), scene.nodes.end(),
                      [&](const tarn::Node& other) { return other.light == lit.light; }) > 1;
    if (is_shared) {
        lit.light = LightIndex(scene.lights.size());
        scene.lights.push_back(std::move(edited));
    } else {
        at(scene.lights, lit.light) = std::move(edited);
    }
    note_edit(*state_);
}

void Scene::remove_light(Node node) {
    find_light(*state_, node);
    std::erase(state_->scene.light_nodes, NodeIndex(node.index));
    find_node_of(*state_, node).light = LightIndex();
    note_edit(*state_);
}

Node Scene::add_light(const Light& light, const Transform& transform) {
    tarn::Scene& scene = state_->scene;
    tarn::Node node;
    node.name = fmt::format("light {}", scene.nodes.size());
    node.local = checked_transform(transform);
    PunctualLight source = checked_light(light, node.name);
    node.light = LightIndex(scene.lights.size());
    scene.lights.push_back(std::move(source));
    scene.light_nodes.emplace_back(scene.nodes.size());
    scene.nodes.push_back(std::move(node));
    note_edit(*state_);
    return {std::uint32_t(scene.nodes.size() - 1)};
}

}  // namespace tarn::api
