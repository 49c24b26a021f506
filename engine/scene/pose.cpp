// Animation, node hierarchy and vertex deformation on the CPU (glTF 2.0 specification, sections 3.7.3
// and 3.11, appendix C).
#include "scene/pose.h"

#include <algorithm>
#include <cmath>
#include <span>

namespace tarn {
namespace {

// Where a time falls between two keys.
struct KeySpan {
    std::size_t first = 0;
    std::size_t second = 0;
    double fraction = 0.0;
    double length_s = 0.0;
};

KeySpan find_span(const std::vector<float>& times_s, double time_s) {
    const std::size_t last = times_s.size() - 1;
    if (time_s <= times_s.front()) return {};
    if (time_s >= times_s.back()) return {last, last, 0.0, 0.0};
    const auto after = std::upper_bound(times_s.begin(), times_s.end(), time_s,
                                        [](double time, float key) { return time < double(key); });
    const std::size_t second = std::size_t(after - times_s.begin());
    const double start_s = times_s[second - 1];
    const double length_s = double(times_s[second]) - start_s;
    return {second - 1, second, (time_s - start_s) / length_s, length_s};
}

// One row of `components` numbers; CUBIC keys have three rows: in tangent, value, out tangent.
std::span<const float> row(const AnimationChannel& channel, std::size_t key, std::size_t part) {
    const std::size_t components = std::size_t(channel.components);
    const std::size_t rows_per_key = channel.interpolation == Interpolation::CUBIC ? 3 : 1;
    return std::span(channel.values).subspan((key * rows_per_key + part) * components, components);
}

std::vector<double> cubic_value(const AnimationChannel& channel, const KeySpan& span) {
    const double t = span.fraction;
    const double t2 = t * t;
    const double t3 = t2 * t;
    const auto p0 = row(channel, span.first, 1);
    const auto m0 = row(channel, span.first, 2);
    const auto m1 = row(channel, span.second, 0);
    const auto p1 = row(channel, span.second, 1);
    std::vector<double> value(p0.size());
    for (std::size_t c = 0; c < value.size(); ++c) {
        value[c] = (2 * t3 - 3 * t2 + 1) * p0[c] + span.length_s * (t3 - 2 * t2 + t) * m0[c] +
                   (-2 * t3 + 3 * t2) * p1[c] + span.length_s * (t3 - t2) * m1[c];
    }
    return value;
}

glm::dquat quaternion(std::span<const float> xyzw) {
    return glm::dquat(xyzw[3], xyzw[0], xyzw[1], xyzw[2]);
}

std::vector<double> linear_value(const AnimationChannel& channel, const KeySpan& span) {
    const auto a = row(channel, span.first, 0);
    const auto b = row(channel, span.second, 0);
    if (channel.property == AnimatedProperty::ROTATION) {
        const glm::dquat q = glm::slerp(quaternion(a), quaternion(b), span.fraction);
        return {q.x, q.y, q.z, q.w};
    }
    std::vector<double> value(a.size());
    for (std::size_t c = 0; c < value.size(); ++c) value[c] = a[c] + span.fraction * (double(b[c]) - a[c]);
    return value;
}

std::vector<double> evaluate_channel(const AnimationChannel& channel, double time_s) {
    const KeySpan span = find_span(channel.times_s, time_s);
    if (channel.interpolation == Interpolation::CUBIC && span.first != span.second)
        return cubic_value(channel, span);
    if (channel.interpolation == Interpolation::LINEAR && span.first != span.second)
        return linear_value(channel, span);
    const auto held = row(channel, span.first, channel.interpolation == Interpolation::CUBIC ? 1 : 0);
    return {held.begin(), held.end()};
}

void apply_channel(const AnimationChannel& channel, double time_s, Transform& local,
                   std::vector<float>& weights) {
    const std::vector<double> value = evaluate_channel(channel, time_s);
    switch (channel.property) {
        case AnimatedProperty::TRANSLATION:
            local.translation = {value[0], value[1], value[2]};
            break;
        case AnimatedProperty::SCALE:
            local.scale = {value[0], value[1], value[2]};
            break;
        case AnimatedProperty::ROTATION: {
            const glm::dquat rotation(value[3], value[0], value[1], value[2]);
            if (glm::length(rotation) > 0.0) local.rotation = glm::normalize(rotation);
            break;
        }
        case AnimatedProperty::WEIGHTS:
            weights.assign(value.begin(), value.end());
            break;
    }
}

glm::dmat4 matrix_of(const Transform& transform) {
    glm::dmat4 matrix = glm::mat4_cast(transform.rotation);
    for (int c = 0; c < 3; ++c) matrix[c] *= transform.scale[c];
    matrix[3] = glm::dvec4(transform.translation, 1.0);
    return matrix;
}

// Multiplies parents in. Parents may come after their children, and chains may be too long for recursion.
void accumulate_transforms(const Scene& scene, std::vector<glm::dmat4>& matrices) {
    std::vector<bool> is_done(matrices.size(), false);
    std::vector<std::size_t> chain;
    for (std::size_t start = 0; start < matrices.size(); ++start) {
        NodeIndex node{start};
        while (node.is_set() && !is_done[node.value]) {
            chain.push_back(node.value);
            node = at(scene.nodes, node).parent;
        }
        for (; !chain.empty(); chain.pop_back()) {
            const std::size_t i = chain.back();
            const NodeIndex parent = scene.nodes[i].parent;
            if (parent.is_set()) matrices[i] = at(matrices, parent) * matrices[i];
            is_done[i] = true;
        }
    }
}

glm::vec3 normalized_or(const glm::vec3& vector, const glm::vec3& otherwise) {
    const float length = glm::length(vector);
    return length > 0.0f && std::isfinite(length) ? vector / length : otherwise;
}

void add_scaled(const std::vector<glm::vec3>& displacements, float weight, std::vector<glm::vec3>& values) {
    for (std::size_t v = 0; v < displacements.size(); ++v) values[v] += weight * displacements[v];
}

void morph(const Mesh& mesh, const std::vector<float>& weights, DeformedMesh& deformed) {
    for (std::size_t i = 0; i < mesh.morph_targets.size() && i < weights.size(); ++i) {
        const MorphTarget& target = mesh.morph_targets[i];
        if (weights[i] == 0.0f) continue;
        add_scaled(target.positions_os, weights[i], deformed.positions_os);
        add_scaled(target.normals_os, weights[i], deformed.normals_os);
        if (deformed.tangents_os.empty()) continue;
        for (std::size_t v = 0; v < target.tangents_os.size(); ++v) {
            deformed.tangents_os[v] += glm::vec4(weights[i] * target.tangents_os[v], 0.0f);
        }
    }
    for (std::size_t v = 0; v < deformed.normals_os.size(); ++v) {
        deformed.normals_os[v] = normalized_or(deformed.normals_os[v], mesh.normals_os[v]);
    }
    for (std::size_t v = 0; v < deformed.tangents_os.size(); ++v) {
        glm::vec4& tangent = deformed.tangents_os[v];
        tangent = glm::vec4(normalized_or(glm::vec3(tangent), glm::vec3(mesh.tangents_os[v])), tangent.w);
    }
}

std::vector<glm::mat4> joint_matrices(const Skin& skin, const Pose& pose, const glm::dvec3& origin_ws) {
    std::vector<glm::mat4> matrices;
    for (std::size_t j = 0; j < skin.joints.size(); ++j) {
        glm::dmat4 origin_from_mesh = at(pose.world_from_node, skin.joints[j]) * skin.joint_from_mesh[j];
        origin_from_mesh[3] -= glm::dvec4(origin_ws, 0.0);
        matrices.emplace_back(origin_from_mesh);
    }
    return matrices;
}

glm::mat4 blend_joints(const Mesh& mesh, const std::vector<glm::mat4>& matrices, std::size_t vertex) {
    const std::size_t count = mesh.positions_os.size();
    glm::mat4 blended(0.0f);
    for (int set = 0; set < mesh.influence_sets; ++set) {
        const glm::u16vec4& joints = mesh.joints[std::size_t(set) * count + vertex];
        const glm::vec4& weights = mesh.weights[std::size_t(set) * count + vertex];
        for (int k = 0; k < 4; ++k) {
            if (weights[k] != 0.0f) blended += weights[k] * matrices[joints[k]];
        }
    }
    return blended;
}

// Normals go with the cofactors, which unlike the inverse transpose exist for any matrix.
glm::mat3 cofactors(const glm::mat3& m) {
    return {glm::cross(m[1], m[2]), glm::cross(m[2], m[0]), glm::cross(m[0], m[1])};
}

void apply_skin(const Mesh& mesh, const std::vector<glm::mat4>& matrices, DeformedMesh& deformed) {
    for (std::size_t v = 0; v < deformed.positions_os.size(); ++v) {
        const glm::mat4 matrix = blend_joints(mesh, matrices, v);
        const glm::mat3 linear(matrix);
        deformed.positions_os[v] = glm::vec3(matrix * glm::vec4(deformed.positions_os[v], 1.0f));
        const float side = glm::determinant(linear) < 0.0f ? -1.0f : 1.0f;
        const glm::vec3 normal = side * (cofactors(linear) * deformed.normals_os[v]);
        deformed.normals_os[v] = normalized_or(normal, deformed.normals_os[v]);
        if (deformed.tangents_os.empty()) continue;
        const glm::vec4 tangent = deformed.tangents_os[v];
        const glm::vec3 turned = normalized_or(linear * glm::vec3(tangent), glm::vec3(tangent));
        deformed.tangents_os[v] = glm::vec4(turned, side * tangent.w);
    }
}

// Positions of one instance in ws, added to `bounds`.
void add_instance_bounds(const Scene& scene, const Instance& instance, const Pose& pose, Bounds& bounds) {
    const Mesh& mesh = at(scene.meshes, instance.mesh);
    // Near the instance itself, so that single precision suffices for skinned vertices.
    const NodeIndex anchor =
        instance.skin.is_set() ? at(scene.skins, instance.skin).joints[0] : instance.node;
    const glm::dvec3 origin_ws(at(pose.world_from_node, anchor)[3]);
    const glm::dmat4 matrix = origin_from_object(scene, instance, pose, origin_ws);
    const auto add_all = [&](const std::vector<glm::vec3>& positions) {
        for (const glm::vec3& position : positions) {
            bounds.add(origin_ws + glm::dvec3(matrix * glm::dvec4(position, 1.0)));
        }
    };
    if (mesh.deforms()) {
        add_all(deform_mesh(scene, instance, pose, origin_ws).positions_os);
    } else {
        add_all(mesh.positions_os);
    }
}

}  // namespace

void apply_animations(const Scene& scene, double time_s,
                      const std::function<AnimatedNode(NodeIndex)>& find_node) {
    if (time_s < 0.0) return;
    for (const Animation& animation : scene.animations) {
        const double looped_s = animation.duration_s > 0.0 ? std::fmod(time_s, animation.duration_s) : 0.0;
        for (const AnimationChannel& channel : animation.channels) {
            const AnimatedNode node = find_node(channel.node);
            apply_channel(channel, looped_s, node.local, node.morph_weights);
        }
    }
}

glm::dmat4 local_matrix(const Node& node, const Transform& local) {
    return node.matrix ? *node.matrix : matrix_of(local);
}

Pose evaluate_pose(const Scene& scene, double time_s) {
    Pose pose;
    std::vector<Transform> locals;
    for (const Node& node : scene.nodes) {
        locals.push_back(node.local);
        pose.morph_weights.push_back(node.morph_weights);
    }
    apply_animations(scene, time_s, [&](NodeIndex node) {
        return AnimatedNode{at(locals, node), at(pose.morph_weights, node)};
    });
    for (std::size_t i = 0; i < scene.nodes.size(); ++i) {
        pose.world_from_node.push_back(local_matrix(scene.nodes[i], locals[i]));
    }
    accumulate_transforms(scene, pose.world_from_node);
    return pose;
}

DeformedMesh deform_mesh(const Scene& scene, const Instance& instance, const Pose& pose,
                         const glm::dvec3& origin_ws) {
    const Mesh& mesh = at(scene.meshes, instance.mesh);
    DeformedMesh deformed{mesh.positions_os, mesh.normals_os, mesh.tangents_os};
    morph(mesh, at(pose.morph_weights, instance.node), deformed);
    if (instance.skin.is_set()) {
        apply_skin(mesh, joint_matrices(at(scene.skins, instance.skin), pose, origin_ws), deformed);
    }
    return deformed;
}

glm::dmat4 origin_from_object(const Scene&, const Instance& instance, const Pose& pose,
                              const glm::dvec3& origin_ws) {
    if (instance.skin.is_set()) return glm::dmat4(1.0);
    glm::dmat4 matrix = at(pose.world_from_node, instance.node);
    matrix[3] -= glm::dvec4(origin_ws, 0.0);
    return matrix;
}

Bounds compute_bounds(const Scene& scene, const Pose& pose) {
    Bounds bounds;
    for (const Instance& instance : scene.instances) add_instance_bounds(scene, instance, pose, bounds);
    return bounds;
}

}  // namespace tarn
