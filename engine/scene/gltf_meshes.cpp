// Primitives: attributes, indices of every mode, morph targets, skin influences.
#include "scene/gltf_meshes.h"

#include <algorithm>
#include <numeric>

#include "core/error.h"
#include "scene/gltf_accessors.h"
#include "scene/normals_tangents.h"

namespace tarn {
namespace {

using Attributes = std::map<std::string, int>;

// Many primitives may share one accessor, so a small file can unfold without end.
constexpr std::size_t MAX_VERTICES = std::size_t(1) << 26;

// Reads `name` for all vertices; empty where the primitive has none.
template <class Value>
std::vector<Value> read_attribute(const GltfDocument& document, const Attributes& attributes,
                                  const std::string& name, std::size_t vertex_count) {
    const auto found = attributes.find(name);
    if (found == attributes.end()) return {};
    const std::size_t count = accessor_count(document, found->second);
    if (count != vertex_count) {
        throw Error("{} (accessors[{}]) has {} elements, POSITION has {}", name, found->second, count,
                    vertex_count);
    }
    return read_elements<Value>(document, found->second, name);
}

std::vector<glm::vec4> read_colors(const GltfDocument& document, const Attributes& attributes,
                                   std::size_t count) {
    const auto found = attributes.find("COLOR_0");
    if (found == attributes.end()) return {};
    std::vector<glm::vec4> colors;
    if (accessor_components(document, found->second) == 3) {
        for (const glm::vec3& rgb : read_attribute<glm::vec3>(document, attributes, "COLOR_0", count)) {
            colors.emplace_back(rgb, 1.0f);
        }
    } else {
        colors = read_attribute<glm::vec4>(document, attributes, "COLOR_0", count);
    }
    for (glm::vec4& color : colors) color = glm::clamp(color, 0.0f, 1.0f);
    return colors;
}

std::vector<glm::u16vec4> read_joint_set(const GltfDocument& document, int accessor,
                                         std::size_t vertex_count) {
    expect_components(document, accessor, 4, "JOINTS");
    if (accessor_count(document, accessor) != vertex_count) {
        throw Error("JOINTS (accessors[{}]) has {} elements, POSITION has {}", accessor,
                    accessor_count(document, accessor), vertex_count);
    }
    std::vector<std::uint32_t> indices(4 * vertex_count);
    read_unsigned(document, accessor, indices);
    std::vector<glm::u16vec4> joints(vertex_count);
    for (std::size_t i = 0; i < indices.size(); ++i) {
        if (indices[i] > 0xffff)
            throw Error("JOINTS (accessors[{}]) holds {}, the limit is 65535", accessor, indices[i]);
        joints[i / 4][int(i % 4)] = std::uint16_t(indices[i]);
    }
    return joints;
}

// Weights of all sets of a vertex are made >= 0 with sum 1; without any, the first joint takes the vertex.
void normalize_weights(Mesh& mesh) {
    const std::size_t count = mesh.positions_os.size();
    for (std::size_t v = 0; v < count; ++v) {
        double sum = 0.0;
        for (int set = 0; set < mesh.influence_sets; ++set) {
            glm::vec4& weights = mesh.weights[std::size_t(set) * count + v];
            weights = glm::max(weights, 0.0f);
            sum += double(weights.x) + weights.y + weights.z + weights.w;
        }
        if (!(sum > 0.0)) {
            mesh.weights[v] = {1.0f, 0.0f, 0.0f, 0.0f};
            continue;
        }
        for (int set = 0; set < mesh.influence_sets; ++set) {
            mesh.weights[std::size_t(set) * count + v] *= float(1.0 / sum);
        }
    }
}

void read_influences(const GltfDocument& document, const Attributes& attributes, Mesh& mesh) {
    const std::size_t count = mesh.positions_os.size();
    for (int set = 0;; ++set) {
        const auto joints = attributes.find(fmt::format("JOINTS_{}", set));
        const auto weights = attributes.find(fmt::format("WEIGHTS_{}", set));
        const bool has_joints = joints != attributes.end();
        if (has_joints != (weights != attributes.end())) {
            throw Error("JOINTS_{0} and WEIGHTS_{0} need each other, only one is there", set);
        }
        if (!has_joints) break;
        const auto set_joints = read_joint_set(document, joints->second, count);
        const auto set_weights = read_attribute<glm::vec4>(document, attributes, weights->first, count);
        mesh.joints.insert(mesh.joints.end(), set_joints.begin(), set_joints.end());
        mesh.weights.insert(mesh.weights.end(), set_weights.begin(), set_weights.end());
        ++mesh.influence_sets;
    }
    if (mesh.influence_sets > 0) normalize_weights(mesh);
}

void read_morph_targets(const GltfDocument& document, const tinygltf::Primitive& primitive, Mesh& mesh) {
    const std::size_t count = mesh.positions_os.size();
    for (const Attributes& attributes : primitive.targets) {
        MorphTarget& target = mesh.morph_targets.emplace_back();
        target.positions_os = read_attribute<glm::vec3>(document, attributes, "POSITION", count);
        target.normals_os = read_attribute<glm::vec3>(document, attributes, "NORMAL", count);
        target.tangents_os = read_attribute<glm::vec3>(document, attributes, "TANGENT", count);
    }
}

std::vector<std::uint32_t> read_indices(const GltfDocument& document, const tinygltf::Primitive& primitive,
                                        std::size_t vertex_count) {
    if (primitive.indices < 0) {
        std::vector<std::uint32_t> indices(vertex_count);
        std::iota(indices.begin(), indices.end(), 0u);
        return indices;
    }
    expect_components(document, primitive.indices, 1, "indices");
    std::vector<std::uint32_t> indices(accessor_count(document, primitive.indices));
    read_unsigned(document, primitive.indices, indices);
    for (std::size_t i = 0; i < indices.size(); ++i) {
        if (indices[i] >= vertex_count) {
            throw Error("index {} (accessors[{}]) is {}, the primitive has {} vertices", i, primitive.indices,
                        indices[i], vertex_count);
        }
    }
    return indices;
}

// Triangle k of a primitive (glTF 2.0 specification, section 3.7.2.1).
glm::uvec3 triangle_of(int mode, const std::vector<std::uint32_t>& indices, std::size_t k) {
    switch (mode) {
        case TINYGLTF_MODE_TRIANGLE_STRIP:
            return {indices[k], indices[k + 1 + k % 2], indices[k + 2 - k % 2]};
        case TINYGLTF_MODE_TRIANGLE_FAN:
            return {indices[k + 1], indices[k + 2], indices[0]};
        default:
            return {indices[3 * k], indices[3 * k + 1], indices[3 * k + 2]};
    }
}

// Triangles that use a vertex twice have no area and are left out.
std::vector<glm::uvec3> assemble_triangles(int mode, const std::vector<std::uint32_t>& indices) {
    const std::size_t strip_count = indices.size() < 3 ? 0 : indices.size() - 2;
    const std::size_t count = mode == TINYGLTF_MODE_TRIANGLES ? indices.size() / 3 : strip_count;
    std::vector<glm::uvec3> triangles;
    triangles.reserve(count);
    for (std::size_t k = 0; k < count; ++k) {
        const glm::uvec3 t = triangle_of(mode, indices, k);
        if (t.x != t.y && t.y != t.z && t.z != t.x) triangles.push_back(t);
    }
    return triangles;
}

void read_tangents(const GltfDocument& document, const Attributes& attributes, Mesh& mesh) {
    mesh.tangents_os = read_attribute<glm::vec4>(document, attributes, "TANGENT", mesh.positions_os.size());
    for (std::size_t v = 0; v < mesh.tangents_os.size(); ++v) {
        glm::vec4& tangent = mesh.tangents_os[v];
        const float length = glm::length(glm::vec3(tangent));
        if (!(length > 0.0f)) {
            mesh.tangents_os.clear();
            return;
        }
        tangent = glm::vec4(glm::vec3(tangent) / length, tangent.w < 0.0f ? -1.0f : 1.0f);
    }
}

// Normals and tangents, from the file or made here. A file's tangents count only beside a file's normals.
void complete_frames(const GltfDocument& document, const Attributes& attributes, const Material& material,
                     Mesh& mesh) {
    const bool needs_tangents = material.normal_map.texture.is_set();
    mesh.normals_os = read_attribute<glm::vec3>(document, attributes, "NORMAL", mesh.positions_os.size());
    if (mesh.normals_os.empty()) {
        add_flat_normals(mesh);
    } else {
        normalize_normals(mesh);
        if (needs_tangents) read_tangents(document, attributes, mesh);
    }
    if (needs_tangents && mesh.tangents_os.empty()) add_tangents(mesh, material.normal_map.uv_set);
}

void compute_mesh_bounds(Mesh& mesh) {
    for (const glm::vec3& position : mesh.positions_os) mesh.bounds_os.add(glm::dvec3(position));
}

std::vector<int> accessors_of(const tinygltf::Primitive& primitive) {
    std::vector<int> accessors;
    for (const auto& [name, accessor] : primitive.attributes) accessors.push_back(accessor);
    for (const Attributes& target : primitive.targets) {
        for (const auto& [name, accessor] : target) accessors.push_back(accessor);
    }
    if (primitive.indices >= 0) accessors.push_back(primitive.indices);
    return accessors;
}

class MeshReader {
  public:
    MeshReader(GltfDocument& document, Scene& scene) : document_(document), scene_(scene) {}

    std::vector<MeshIndex> read(std::size_t index) {
        const tinygltf::Mesh& source = document_.model.meshes[index];
        std::vector<MeshIndex> meshes;
        for (std::size_t p = 0; p < source.primitives.size(); ++p) {
            const std::string label = fmt::format("meshes[{}].primitives[{}]", index, p);
            try {
                if (!can_read(source.primitives[p], label)) continue;
                Mesh mesh = read_primitive(source.primitives[p]);
                if (mesh.triangles.empty()) continue;
                mesh.name = source.name.empty() ? fmt::format("mesh {}", index) : source.name;
                meshes.push_back(MeshIndex(scene_.meshes.size()));
                scene_.meshes.push_back(std::move(mesh));
            } catch (const Error& error) {
                throw Error("{}: {}", label, error.what());
            }
        }
        return meshes;
    }

  private:
    // False, and a warning, for what is valid but shows nothing.
    bool can_read(const tinygltf::Primitive& primitive, const std::string& label) {
        if (primitive.mode > TINYGLTF_MODE_TRIANGLE_FAN)
            throw Error("mode is {}, 0 to 6 is allowed", primitive.mode);
        if (primitive.mode < TINYGLTF_MODE_TRIANGLES) {
            document_.warn(label + " holds points or lines, it is skipped");
            return false;
        }
        if (!primitive.attributes.contains("POSITION")) {
            document_.warn(label + " has no POSITION, it is skipped");
            return false;
        }
        for (const int accessor : accessors_of(primitive)) {
            if (has_data(document_, accessor)) continue;
            document_.warn(fmt::format("{} reads accessors[{}], whose buffer has no data: it is skipped",
                                       label, accessor));
            return false;
        }
        return true;
    }

    void count_vertices(std::size_t count) {
        vertex_total_ += count;
        if (vertex_total_ > MAX_VERTICES) {
            throw Error("the file unfolds to more than {} vertices", MAX_VERTICES);
        }
    }

    Mesh read_primitive(const tinygltf::Primitive& primitive) {
        const Attributes& attributes = primitive.attributes;
        const int position_accessor = attributes.at("POSITION");
        const std::size_t count = accessor_count(document_, position_accessor);
        count_vertices(count * (1 + primitive.targets.size()));
        const std::size_t index_accessor_count =
            primitive.indices < 0 ? count : accessor_count(document_, primitive.indices);
        count_vertices(index_accessor_count);

        Mesh mesh;
        const std::size_t default_material = scene_.materials.size() - 1;
        mesh.material =
            MaterialIndex(primitive.material < 0 ? default_material : std::size_t(primitive.material));
        mesh.positions_os = read_elements<glm::vec3>(document_, position_accessor, "POSITION");
        mesh.uv0 = read_attribute<glm::vec2>(document_, attributes, "TEXCOORD_0", count);
        mesh.uv1 = read_attribute<glm::vec2>(document_, attributes, "TEXCOORD_1", count);
        mesh.colors = read_colors(document_, attributes, count);
        read_influences(document_, attributes, mesh);
        read_morph_targets(document_, primitive, mesh);
        mesh.triangles = assemble_triangles(primitive.mode, read_indices(document_, primitive, count));
        if (mesh.triangles.empty()) return mesh;
        complete_frames(document_, attributes, at(scene_.materials, mesh.material), mesh);
        compute_mesh_bounds(mesh);
        return mesh;
    }

    GltfDocument& document_;
    Scene& scene_;
    std::size_t vertex_total_ = 0;
};

}  // namespace

std::vector<std::vector<MeshIndex>> add_meshes(GltfDocument& document, Scene& scene) {
    MeshReader reader(document, scene);
    std::vector<std::vector<MeshIndex>> meshes;
    for (std::size_t i = 0; i < document.model.meshes.size(); ++i) {
        morph_target_count(document, int(i));
        meshes.push_back(reader.read(i));
    }
    return meshes;
}

std::size_t morph_target_count(const GltfDocument& document, int mesh) {
    const tinygltf::Mesh& source = document.model.meshes[std::size_t(mesh)];
    const std::size_t count = source.primitives.empty() ? 0 : source.primitives[0].targets.size();
    for (const tinygltf::Primitive& primitive : source.primitives) {
        if (primitive.targets.size() != count) {
            throw Error("meshes[{}] has primitives with {} and with {} morph targets", mesh, count,
                        primitive.targets.size());
        }
    }
    return count;
}

}  // namespace tarn
