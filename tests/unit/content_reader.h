// Reads a generated .glb back, apart from the engine's importer, as plain world-space triangles.
#pragma once

#include <gtest/gtest.h>
#include <tiny_gltf.h>

#include <cstring>
#include <functional>
#include <glm/glm.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/quaternion.hpp>
#include <string>
#include <vector>

namespace tarn::content {

struct ReadTriangle {
    glm::vec3 corners[3];
    glm::vec3 normals[3];
    int material;
    int node;
};

struct ReadScene {
    tinygltf::Model model;
    std::vector<ReadTriangle> triangles;  // of every instance, in the rest pose
    std::size_t instances = 0;            // primitives placed by nodes
    std::size_t bad_indices = 0;          // indices that lie outside their vertices

    // Emitted radiance of a material, textures left out.
    glm::dvec3 radiance(int material) const {
        const tinygltf::Material& m = model.materials[material];
        const auto strength = m.extensions.find("KHR_materials_emissive_strength");
        if (strength == m.extensions.end()) return glm::dvec3(0.0);
        return strength->second.Get("emissiveStrength").GetNumberAsDouble() *
               glm::dvec3(m.emissiveFactor[0], m.emissiveFactor[1], m.emissiveFactor[2]);
    }
};

inline double area(const ReadTriangle& t) {
    return 0.5 * glm::length(glm::cross(glm::dvec3(t.corners[1] - t.corners[0]),
                                        glm::dvec3(t.corners[2] - t.corners[0])));
}

inline const unsigned char* bytes_of(const tinygltf::Model& model, int accessor) {
    const tinygltf::Accessor& a = model.accessors[accessor];
    const tinygltf::BufferView& view = model.bufferViews[a.bufferView];
    return model.buffers[view.buffer].data.data() + view.byteOffset + a.byteOffset;
}

inline glm::mat4 local_transform(const tinygltf::Node& node) {
    glm::mat4 matrix(1.0f);
    const auto& t = node.translation;
    const auto& r = node.rotation;
    if (!t.empty()) matrix = glm::translate(matrix, glm::vec3(t[0], t[1], t[2]));
    if (!r.empty()) matrix *= glm::mat4_cast(glm::quat(r[3], r[0], r[1], r[2]));
    if (!node.scale.empty())
        matrix = glm::scale(matrix, glm::vec3(node.scale[0], node.scale[1], node.scale[2]));
    return matrix;
}

inline std::uint32_t index_at(const tinygltf::Model& model, int accessor, std::size_t i) {
    const unsigned char* bytes = bytes_of(model, accessor);
    if (model.accessors[accessor].componentType == TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT) {
        std::uint16_t index;
        std::memcpy(&index, bytes + 2 * i, 2);
        return index;
    }
    std::uint32_t index;
    std::memcpy(&index, bytes + 4 * i, 4);
    return index;
}

inline void read_primitive(ReadScene& scene, const tinygltf::Primitive& primitive, const glm::mat4& place,
                           int node) {
    const tinygltf::Model& model = scene.model;
    const int positions = primitive.attributes.at("POSITION"), normals = primitive.attributes.at("NORMAL");
    const std::size_t vertices = model.accessors[positions].count;
    const glm::mat3 normal_matrix = glm::transpose(glm::inverse(glm::mat3(place)));
    ++scene.instances;
    for (std::size_t i = 0; i + 2 < model.accessors[primitive.indices].count; i += 3) {
        ReadTriangle triangle{{}, {}, primitive.material, node};
        for (int corner = 0; corner < 3; ++corner) {
            const std::uint32_t index = index_at(model, primitive.indices, i + corner);
            if (index >= vertices) {
                ++scene.bad_indices;
                continue;
            }
            glm::vec3 position, normal;
            std::memcpy(&position, bytes_of(model, positions) + 12 * index, 12);
            std::memcpy(&normal, bytes_of(model, normals) + 12 * index, 12);
            triangle.corners[corner] = glm::vec3(place * glm::vec4(position, 1.0f));
            triangle.normals[corner] = normal_matrix * normal;
        }
        scene.triangles.push_back(triangle);
    }
}

// Fails the calling test where tinygltf has anything to say about the file.
inline ReadScene read_scene(const std::string& bytes) {
    ReadScene scene;
    std::string error, warning;
    tinygltf::TinyGLTF loader;
    const auto* data = reinterpret_cast<const unsigned char*>(bytes.data());
    EXPECT_TRUE(loader.LoadBinaryFromMemory(&scene.model, &error, &warning, data,
                                            static_cast<unsigned>(bytes.size())));
    EXPECT_EQ(error, "");
    EXPECT_EQ(warning, "");
    const std::function<void(int, const glm::mat4&)> visit = [&](int index, const glm::mat4& parent) {
        const tinygltf::Node& node = scene.model.nodes[index];
        const glm::mat4 place = parent * local_transform(node);
        if (node.mesh >= 0) {
            for (const tinygltf::Primitive& p : scene.model.meshes[node.mesh].primitives)
                read_primitive(scene, p, place, index);
        }
        for (const int child : node.children) visit(child, place);
    };
    for (const int root : scene.model.scenes.at(scene.model.defaultScene).nodes) visit(root, glm::mat4(1.0f));
    return scene;
}

}  // namespace tarn::content
