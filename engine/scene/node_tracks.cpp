#include "scene/node_tracks.h"

#include <algorithm>
#include <limits>

#include "core/error.h"

namespace tarn {
namespace {

NodeIndex find_node(const Scene& scene, const std::string& name) {
    const auto is_it = [&](const Node& node) { return node.name == name; };
    const auto found = std::find_if(scene.nodes.begin(), scene.nodes.end(), is_it);
    if (found == scene.nodes.end())
        throw Error("a track moves '{}': the scene has no node of that name", name);
    if (std::find_if(found + 1, scene.nodes.end(), is_it) != scene.nodes.end()) {
        throw Error("a track moves '{}': several nodes of the scene have that name", name);
    }
    if (found->matrix) throw Error("a track moves '{}': that node is placed by a matrix", name);
    return NodeIndex(std::uint32_t(found - scene.nodes.begin()));
}

struct Place {
    double time_s;
    glm::dvec3 position;
};

// Of the curve at place i, per second: the difference of its neighbours over their time.
glm::dvec3 tangent(std::span<const Place> places, std::size_t i) {
    const Place& before = places[i > 0 ? i - 1 : 0];
    const Place& after = places[std::min(i + 1, places.size() - 1)];
    if (after.time_s <= before.time_s) return glm::dvec3(0.0);
    return (after.position - before.position) / (after.time_s - before.time_s);
}

void append(std::vector<float>& values, const glm::dvec3& v) {
    for (int c = 0; c < 3; ++c) values.push_back(float(v[c]));
}

AnimationChannel make_translation(NodeIndex node, std::span<const Place> places) {
    AnimationChannel channel{node, AnimatedProperty::TRANSLATION, Interpolation::CUBIC, {}, {}, 3};
    for (std::size_t i = 0; i < places.size(); ++i) {
        channel.times_s.push_back(float(places[i].time_s));
        append(channel.values, tangent(places, i));
        append(channel.values, places[i].position);
        append(channel.values, tangent(places, i));
    }
    return channel;
}

glm::dquat quaternion_of(const glm::dvec3& rotation_deg) {
    const glm::dvec3 angles = glm::radians(rotation_deg);
    return glm::angleAxis(angles.z, glm::dvec3(0, 0, 1)) * glm::angleAxis(angles.y, glm::dvec3(0, 1, 0)) *
           glm::angleAxis(angles.x, glm::dvec3(1, 0, 0));
}

void add_channels(Animation& animation, NodeIndex node, const NodeTrack& track) {
    std::vector<Place> places;
    AnimationChannel rotation{node, AnimatedProperty::ROTATION, Interpolation::LINEAR, {}, {}, 4};
    for (const NodeKey& key : track.keys) {
        if (key.position_ns) places.push_back({key.time_s, *key.position_ns});
        if (!key.rotation_deg) continue;
        const glm::dquat q = quaternion_of(*key.rotation_deg);
        rotation.times_s.push_back(float(key.time_s));
        for (const double c : {q.x, q.y, q.z, q.w}) rotation.values.push_back(float(c));
    }
    if (!places.empty()) animation.channels.push_back(make_translation(node, places));
    if (!rotation.times_s.empty()) animation.channels.push_back(std::move(rotation));
}

}  // namespace

void add_tracks(Scene& scene, std::span<const NodeTrack> tracks) {
    if (tracks.empty()) return;
    Animation animation;
    animation.name = "flythrough";
    animation.duration_s = std::numeric_limits<double>::infinity();  // plays once
    for (const NodeTrack& track : tracks) add_channels(animation, find_node(scene, track.node), track);
    scene.animations.push_back(std::move(animation));
}

}  // namespace tarn
