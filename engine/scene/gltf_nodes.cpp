// The node tree, and what its nodes carry: meshes, skins, cameras, lights.
#include "scene/gltf_nodes.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/type_ptr.hpp>

#include "core/error.h"
#include "scene/gltf_accessors.h"
#include "scene/gltf_meshes.h"

namespace tarn {
namespace {

glm::dvec3 vec3_or(const std::vector<double>& values, const glm::dvec3& otherwise) {
    return values.size() == 3 ? glm::dvec3(values[0], values[1], values[2]) : otherwise;
}

glm::dquat read_rotation(const std::vector<double>& xyzw) {
    if (xyzw.size() != 4) return glm::dquat(1.0, 0.0, 0.0, 0.0);
    const glm::dquat rotation(xyzw[3], xyzw[0], xyzw[1], xyzw[2]);
    const double length = glm::length(rotation);
    return length > 0.0 ? rotation / length : glm::dquat(1.0, 0.0, 0.0, 0.0);
}

void check_matrix(const glm::dmat4& matrix, std::size_t node) {
    if (matrix[0][3] != 0.0 || matrix[1][3] != 0.0 || matrix[2][3] != 0.0 || matrix[3][3] != 1.0) {
        throw Error("nodes[{}].matrix is not affine, its last row must be 0 0 0 1", node);
    }
}

std::vector<float> rest_weights(const GltfDocument& document, std::size_t index) {
    const tinygltf::Node& node = document.model.nodes[index];
    if (node.mesh < 0) return {};
    const std::size_t target_count = morph_target_count(document, node.mesh);
    const std::vector<double>& of_mesh = document.model.meshes[std::size_t(node.mesh)].weights;
    const std::vector<double>& weights = node.weights.empty() ? of_mesh : node.weights;
    if (!weights.empty() && weights.size() != target_count) {
        throw Error("nodes[{}] has {} morph weights, meshes[{}] has {} targets", index, weights.size(),
                    node.mesh, target_count);
    }
    std::vector<float> rest(target_count, 0.0f);
    std::copy(weights.begin(), weights.end(), rest.begin());
    return rest;
}

Node read_node(const GltfDocument& document, std::size_t index) {
    const tinygltf::Node& source = document.model.nodes[index];
    Node node;
    node.name = source.name;
    if (source.matrix.size() == 16) {
        node.matrix = glm::make_mat4(source.matrix.data());
        check_matrix(*node.matrix, index);
    } else {
        node.local.translation = vec3_or(source.translation, glm::dvec3(0.0));
        node.local.rotation = read_rotation(source.rotation);
        node.local.scale = vec3_or(source.scale, glm::dvec3(1.0));
    }
    node.morph_weights = rest_weights(document, index);
    return node;
}

Skin read_skin(const GltfDocument& document, std::size_t index) {
    const tinygltf::Skin& source = document.model.skins[index];
    if (source.joints.empty()) throw Error("skins[{}] has no joints", index);
    Skin skin;
    for (const int joint : source.joints) skin.joints.push_back(NodeIndex(joint));
    skin.joint_from_mesh.assign(skin.joints.size(), glm::dmat4(1.0));
    if (source.inverseBindMatrices < 0) return skin;
    const auto matrices =
        read_elements<glm::mat4>(document, source.inverseBindMatrices, "inverseBindMatrices");
    if (matrices.size() < skin.joints.size()) {
        throw Error("skins[{}] has {} inverse bind matrices for {} joints", index, matrices.size(),
                    skin.joints.size());
    }
    std::copy_n(matrices.begin(), skin.joints.size(), skin.joint_from_mesh.begin());
    return skin;
}

void check_joints(const Mesh& mesh, const Skin& skin, std::size_t node) {
    for (const glm::u16vec4& joints : mesh.joints) {
        const int highest = std::max({int(joints.x), int(joints.y), int(joints.z), int(joints.w)});
        if (std::size_t(highest) >= skin.joints.size()) {
            throw Error("nodes[{}]: a vertex of '{}' follows joint {}, the skin has {}", node, mesh.name,
                        highest, skin.joints.size());
        }
    }
}

Camera read_camera(const tinygltf::Camera& source, int index, std::size_t node,
                   const std::string& node_name) {
    Camera camera;
    camera.name = source.name.empty() ? node_name : source.name;
    camera.node = NodeIndex(node);
    camera.orthographic = source.type == "orthographic";
    if (camera.orthographic) {
        camera.half_height_m = std::abs(source.orthographic.ymag);
        if (camera.half_height_m == 0.0) throw Error("cameras[{}].orthographic.ymag is 0", index);
        return camera;
    }
    camera.vertical_fov_rad = source.perspective.yfov;
    if (!(camera.vertical_fov_rad > 0.0 && camera.vertical_fov_rad < M_PI)) {
        throw Error("cameras[{}].perspective.yfov is {}, between 0 and pi is allowed", index,
                    camera.vertical_fov_rad);
    }
    return camera;
}

int choose_scene(const tinygltf::Model& model, int wanted) {
    if (wanted >= 0) {
        if (std::size_t(wanted) >= model.scenes.size()) {
            throw Error("scene {} is asked for, the file has {}", wanted, model.scenes.size());
        }
        return wanted;
    }
    if (model.defaultScene >= 0) return model.defaultScene;
    return model.scenes.empty() ? -1 : 0;
}

}  // namespace

void add_nodes(GltfDocument& document, Scene& scene) {
    for (std::size_t i = 0; i < document.model.nodes.size(); ++i)
        scene.nodes.push_back(read_node(document, i));
    for (std::size_t i = 0; i < document.model.nodes.size(); ++i) {
        for (const int child : document.model.nodes[i].children)
            scene.nodes[std::size_t(child)].parent = NodeIndex(i);
    }
}

std::vector<bool> find_shown_nodes(const GltfDocument& document, int scene_index, Scene& scene) {
    const tinygltf::Model& model = document.model;
    const int chosen = choose_scene(model, scene_index);
    if (chosen < 0) return std::vector<bool>(model.nodes.size(), true);
    scene.name = model.scenes[std::size_t(chosen)].name;
    std::vector<bool> is_shown(model.nodes.size(), false);
    std::vector<int> open = model.scenes[std::size_t(chosen)].nodes;
    while (!open.empty()) {
        const std::size_t node = std::size_t(open.back());
        open.pop_back();
        is_shown[node] = true;
        open.insert(open.end(), model.nodes[node].children.begin(), model.nodes[node].children.end());
    }
    return is_shown;
}

void add_skins(GltfDocument& document, Scene& scene) {
    for (std::size_t i = 0; i < document.model.skins.size(); ++i)
        scene.skins.push_back(read_skin(document, i));
}

void add_instances(GltfDocument& document, const std::vector<bool>& is_shown,
                   const std::vector<std::vector<MeshIndex>>& meshes, Scene& scene) {
    for (std::size_t i = 0; i < is_shown.size(); ++i) {
        const tinygltf::Node& node = document.model.nodes[i];
        if (node.mesh < 0) continue;
        for (const MeshIndex index : meshes[std::size_t(node.mesh)]) {
            Instance instance{index, NodeIndex(i), SkinIndex()};
            const Mesh& mesh = at(scene.meshes, index);
            if (node.skin >= 0 && mesh.influence_sets > 0) {
                instance.skin = SkinIndex(node.skin);
                check_joints(mesh, at(scene.skins, instance.skin), i);
            }
            if (node.skin >= 0 && mesh.influence_sets == 0) {
                document.warn(fmt::format("nodes[{}] has a skin, '{}' has no JOINTS_0: it is not skinned", i,
                                          mesh.name));
            }
            if (is_shown[i]) scene.instances.push_back(instance);
        }
    }
}

void add_cameras(const GltfDocument& document, const std::vector<bool>& is_shown, Scene& scene) {
    for (std::size_t i = 0; i < is_shown.size(); ++i) {
        const int index = document.model.nodes[i].camera;
        if (!is_shown[i] || index < 0) continue;
        scene.nodes[i].camera = CameraIndex(scene.cameras.size());
        scene.cameras.push_back(
            read_camera(document.model.cameras[std::size_t(index)], index, i, scene.nodes[i].name));
    }
}

void drop_unused_meshes(Scene& scene) {
    std::vector<MeshIndex> new_index(scene.meshes.size());
    std::vector<bool> is_used(scene.meshes.size(), false);
    for (const Instance& instance : scene.instances) is_used[instance.mesh.value] = true;
    std::size_t kept = 0;
    for (std::size_t i = 0; i < scene.meshes.size(); ++i) {
        if (!is_used[i]) continue;
        new_index[i] = MeshIndex(kept);
        if (kept != i) scene.meshes[kept] = std::move(scene.meshes[i]);
        ++kept;
    }
    scene.meshes.resize(kept);
    for (Instance& instance : scene.instances) instance.mesh = new_index[instance.mesh.value];
}

}  // namespace tarn
