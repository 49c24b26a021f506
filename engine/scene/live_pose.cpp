#include "scene/live_pose.h"

namespace tarn {
namespace {

constexpr std::uint32_t NOT_ANIMATED = UINT32_MAX;

}  // namespace

void LivePose::reset(const Scene& scene, double time_s) {
    pose_ = evaluate_pose(scene, time_s);
    list_children(scene);
    list_animated(scene);
    touched_.clear();
    is_root_.assign(scene.nodes.size(), false);
}

void LivePose::list_children(const Scene& scene) {
    const std::size_t count = scene.nodes.size();
    first_child_.assign(count + 1, 0);
    for (const Node& node : scene.nodes) {
        if (node.parent.is_set()) ++first_child_[node.parent.value + 1];
    }
    for (std::size_t i = 0; i < count; ++i) first_child_[i + 1] += first_child_[i];
    children_.resize(first_child_[count]);
    std::vector<std::uint32_t> next(first_child_.begin(), first_child_.end() - 1);
    for (std::size_t i = 0; i < count; ++i) {
        const NodeIndex parent = scene.nodes[i].parent;
        if (parent.is_set()) children_[next[parent.value]++] = NodeIndex(i);
    }
}

void LivePose::list_animated(const Scene& scene) {
    animated_.clear();
    animated_of_node_.assign(scene.nodes.size(), NOT_ANIMATED);
    for (const Animation& animation : scene.animations) {
        for (const AnimationChannel& channel : animation.channels) {
            std::uint32_t& slot = at(animated_of_node_, channel.node);
            if (slot != NOT_ANIMATED) continue;
            slot = std::uint32_t(animated_.size());
            animated_.push_back(channel.node);
        }
    }
}

void LivePose::evaluate_animations(const Scene& scene, double time_s) {
    animated_locals_.clear();
    for (const NodeIndex node : animated_) {
        animated_locals_.push_back(at(scene.nodes, node).local);
        at(pose_.morph_weights, node) = at(scene.nodes, node).morph_weights;
    }
    apply_animations(scene, time_s, [&](NodeIndex node) {
        return AnimatedNode{animated_locals_[at(animated_of_node_, node)], at(pose_.morph_weights, node)};
    });
}

void LivePose::follow(const Scene& scene, double time_s, std::span<const NodeIndex> moved) {
    touched_.clear();
    evaluate_animations(scene, time_s);
    for (const NodeIndex node : animated_) is_root_[node.value] = true;
    for (const NodeIndex node : moved) is_root_[node.value] = true;
    const auto hangs_below_a_root = [&](NodeIndex node) {
        for (NodeIndex up = at(scene.nodes, node).parent; up.is_set(); up = at(scene.nodes, up).parent) {
            if (is_root_[up.value]) return true;
        }
        return false;
    };
    std::vector<NodeIndex> topmost;
    const auto add_topmost = [&](NodeIndex node) {
        if (is_root_[node.value] && !hangs_below_a_root(node)) topmost.push_back(node);
    };
    for (const NodeIndex node : animated_) add_topmost(node);
    for (const NodeIndex node : moved) add_topmost(node);
    for (const NodeIndex node : animated_) is_root_[node.value] = false;
    for (const NodeIndex node : moved) is_root_[node.value] = false;
    for (const NodeIndex node : topmost) {
        if (is_root_[node.value]) continue;  // named twice
        is_root_[node.value] = true;
        touch_below(scene, node);
    }
    for (const NodeIndex node : topmost) is_root_[node.value] = false;
}

void LivePose::touch_below(const Scene& scene, NodeIndex root) {
    stack_.assign(1, root);
    while (!stack_.empty()) {
        const NodeIndex index = stack_.back();
        stack_.pop_back();
        const Node& node = at(scene.nodes, index);
        const std::uint32_t slot = at(animated_of_node_, index);
        const glm::dmat4 local =
            local_matrix(node, slot == NOT_ANIMATED ? node.local : animated_locals_[slot]);
        at(pose_.world_from_node, index) =
            node.parent.is_set() ? at(pose_.world_from_node, node.parent) * local : local;
        touched_.push_back(index);
        for (std::uint32_t i = first_child_[index.value]; i < first_child_[index.value + 1]; ++i) {
            stack_.push_back(children_[i]);
        }
    }
}

}  // namespace tarn
