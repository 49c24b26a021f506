// Document-level validation of glTF tables: byte ranges and graphs.
#include "scene/gltf_checks.h"

#include "core/error.h"

namespace tarn {
namespace {

// An accessor without a buffer view is zeros that cost the file nothing, so it needs a limit of its own.
constexpr std::size_t MAX_ELEMENTS_WITHOUT_DATA = 1u << 20;

void check_buffer_views(const GltfDocument& document) {
    for (int i = 0; i < document.no_data_view; ++i) {
        const tinygltf::BufferView& view = document.model.bufferViews[std::size_t(i)];
        const std::size_t length = document.buffer_lengths[std::size_t(view.buffer)];
        if (view.byteOffset > length || view.byteLength > length - view.byteOffset) {
            throw Error("bufferViews[{}] reads {} bytes from byte {}, buffers[{}] has {}", i, view.byteLength,
                        view.byteOffset, view.buffer, length);
        }
        if (view.byteStride != 0 && (view.byteStride < 4 || view.byteStride > 252)) {
            throw Error("bufferViews[{}].byteStride is {}, 4 to 252 is allowed", i, view.byteStride);
        }
    }
}

void check_range(const GltfDocument& document, int view_index, std::size_t offset, std::size_t count,
                 std::size_t stride, std::size_t used_bytes, const std::string& name) {
    const tinygltf::BufferView& view = document.model.bufferViews[std::size_t(view_index)];
    if (count == 0) return;
    const std::size_t needed = offset + (count - 1) * stride + used_bytes;
    if (needed > view.byteLength) {
        throw Error("{} reads {} elements up to byte {}, bufferViews[{}] has {} bytes", name, count, needed,
                    view_index, view.byteLength);
    }
}

void check_sparse(const GltfDocument& document, const tinygltf::Accessor& accessor,
                  const ElementLayout& layout, const std::string& name) {
    const auto& sparse = accessor.sparse;
    if (std::size_t(sparse.count) > accessor.count) {
        throw Error("{}.sparse.count is {}, the accessor has {} elements", name, sparse.count,
                    accessor.count);
    }
    tinygltf::Accessor indices;
    indices.componentType = sparse.indices.componentType;
    indices.type = TINYGLTF_TYPE_SCALAR;
    const std::size_t index_bytes = layout_of(indices, name + ".sparse.indices").component_bytes;
    check_range(document, sparse.indices.bufferView, std::size_t(sparse.indices.byteOffset),
                std::size_t(sparse.count), index_bytes, index_bytes, name + ".sparse.indices");
    check_range(document, sparse.values.bufferView, std::size_t(sparse.values.byteOffset),
                std::size_t(sparse.count), layout.element_bytes, layout.used_bytes, name + ".sparse.values");
}

void check_accessors(const GltfDocument& document) {
    for (std::size_t i = 0; i < document.model.accessors.size(); ++i) {
        const tinygltf::Accessor& accessor = document.model.accessors[i];
        const std::string name = fmt::format("accessors[{}]", i);
        const ElementLayout layout = layout_of(accessor, name);
        if (accessor.bufferView == document.no_data_view) {
            if (accessor.count > MAX_ELEMENTS_WITHOUT_DATA) {
                throw Error("{} claims {} elements without data, the limit is {}", name, accessor.count,
                            MAX_ELEMENTS_WITHOUT_DATA);
            }
        } else {
            const auto& view = document.model.bufferViews[std::size_t(accessor.bufferView)];
            const std::size_t stride = view.byteStride != 0 ? view.byteStride : layout.element_bytes;
            if (stride < layout.element_bytes) {
                throw Error("bufferViews[{}].byteStride is {}, an element of {} has {} bytes",
                            accessor.bufferView, stride, name, layout.element_bytes);
            }
            check_range(document, accessor.bufferView, accessor.byteOffset, accessor.count, stride,
                        layout.used_bytes, name);
        }
        if (accessor.sparse.isSparse) check_sparse(document, accessor, layout, name);
    }
}

std::vector<int> find_parents(const tinygltf::Model& model) {
    std::vector<int> parents(model.nodes.size(), -1);
    for (std::size_t i = 0; i < model.nodes.size(); ++i) {
        for (const int child : model.nodes[i].children) {
            int& parent = parents[std::size_t(child)];
            if (parent >= 0)
                throw Error("nodes[{}] has two parents, nodes[{}] and nodes[{}]", child, parent, i);
            parent = int(i);
        }
    }
    return parents;
}

// With one parent at most for each node, a cycle is a walk towards the root that never ends.
void check_node_tree(const tinygltf::Model& model) {
    const std::vector<int> parents = find_parents(model);
    std::vector<bool> reaches_root(parents.size(), false);
    for (std::size_t start = 0; start < parents.size(); ++start) {
        std::size_t steps = 0;
        int node = int(start);
        while (node >= 0 && !reaches_root[std::size_t(node)]) {
            if (++steps > parents.size()) throw Error("nodes[{}] is its own ancestor", start);
            node = parents[std::size_t(node)];
        }
        for (node = int(start); node >= 0 && !reaches_root[std::size_t(node)];) {
            reaches_root[std::size_t(node)] = true;
            node = parents[std::size_t(node)];
        }
    }
    for (std::size_t i = 0; i < model.scenes.size(); ++i) {
        for (const int node : model.scenes[i].nodes) {
            const int parent = parents[std::size_t(node)];
            if (parent >= 0) {
                throw Error("scenes[{}] lists nodes[{}], which is no root: its parent is nodes[{}]", i, node,
                            parent);
            }
        }
    }
}

void check_node_references(const tinygltf::Model& model) {
    for (std::size_t i = 0; i < model.nodes.size(); ++i) {
        const auto extension = model.nodes[i].extensions.find("KHR_lights_punctual");
        if (extension == model.nodes[i].extensions.end()) continue;
        const int light = extension->second.Get("light").GetNumberAsInt();
        if (std::size_t(light) >= model.lights.size()) {
            throw Error("nodes[{}].extensions.KHR_lights_punctual.light is {}, the file has {} lights", i,
                        light, model.lights.size());
        }
    }
}

void check_animation_references(const tinygltf::Model& model) {
    for (std::size_t i = 0; i < model.animations.size(); ++i) {
        const tinygltf::Animation& animation = model.animations[i];
        for (std::size_t k = 0; k < animation.channels.size(); ++k) {
            const int sampler = animation.channels[k].sampler;
            if (std::size_t(sampler) >= animation.samplers.size()) {
                throw Error("animations[{}].channels[{}].sampler is {}, the animation has {} samplers", i, k,
                            sampler, animation.samplers.size());
            }
        }
    }
}

}  // namespace

ElementLayout layout_of(const tinygltf::Accessor& accessor, const std::string& name) {
    const bool known = accessor.componentType >= TINYGLTF_COMPONENT_TYPE_BYTE &&
                       accessor.componentType <= TINYGLTF_COMPONENT_TYPE_FLOAT &&
                       accessor.componentType != TINYGLTF_COMPONENT_TYPE_INT;
    if (!known) throw Error("{}.componentType is {}, glTF has no such type", name, accessor.componentType);
    ElementLayout layout;
    layout.component_bytes =
        std::size_t(tinygltf::GetComponentSizeInBytes(std::uint32_t(accessor.componentType)));
    layout.component_count = std::size_t(tinygltf::GetNumComponentsInType(std::uint32_t(accessor.type)));
    layout.element_bytes = layout.component_bytes * layout.component_count;
    layout.used_bytes = layout.element_bytes;
    const bool is_matrix = accessor.type == TINYGLTF_TYPE_MAT2 || accessor.type == TINYGLTF_TYPE_MAT3;
    if (!is_matrix) return layout;
    const std::size_t side = accessor.type == TINYGLTF_TYPE_MAT2 ? 2 : 3;
    const std::size_t column_bytes = (side * layout.component_bytes + 3) / 4 * 4;
    layout.element_bytes = side * column_bytes;
    layout.used_bytes = (side - 1) * column_bytes + side * layout.component_bytes;
    return layout;
}

void check_gltf_document(const GltfDocument& document) {
    check_buffer_views(document);
    check_accessors(document);
    check_node_tree(document.model);
    check_node_references(document.model);
    check_animation_references(document.model);
}

}  // namespace tarn
