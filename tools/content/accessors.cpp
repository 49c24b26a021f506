// Buffer views and accessors, one view for each accessor.
#include "content/accessors.h"

namespace tarn::content {

int AccessorStore::add_view(const void* data, std::size_t size_bytes, int target) {
    std::vector<unsigned char>& bytes = model_.buffers[0].data;
    while (bytes.size() % 4 != 0) bytes.push_back(0);
    tinygltf::BufferView view;
    view.buffer = 0;
    view.byteOffset = bytes.size();
    view.byteLength = size_bytes;
    view.target = target;
    const auto* first = static_cast<const unsigned char*>(data);
    bytes.insert(bytes.end(), first, first + size_bytes);
    model_.bufferViews.push_back(view);
    return static_cast<int>(model_.bufferViews.size()) - 1;
}

int AccessorStore::add(int view, int component_type, int type, std::size_t count) {
    tinygltf::Accessor accessor;
    accessor.bufferView = view;
    accessor.componentType = component_type;
    accessor.type = type;
    accessor.count = count;
    model_.accessors.push_back(accessor);
    return static_cast<int>(model_.accessors.size()) - 1;
}

int AccessorStore::add_triangles(const std::vector<glm::uvec3>& triangles, std::size_t vertex_count) {
    const std::size_t count = 3 * triangles.size();
    constexpr int TARGET = TINYGLTF_TARGET_ELEMENT_ARRAY_BUFFER;
    if (vertex_count > 65535) {  // 65535 itself would restart a primitive
        const int view = add_view(triangles.data(), count * sizeof(std::uint32_t), TARGET);
        return add(view, TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT, TINYGLTF_TYPE_SCALAR, count);
    }
    std::vector<std::uint16_t> indices;
    for (const glm::uvec3& triangle : triangles) {
        for (int corner = 0; corner < 3; ++corner)
            indices.push_back(static_cast<std::uint16_t>(triangle[corner]));
    }
    const int view = add_view(indices.data(), count * sizeof(std::uint16_t), TARGET);
    return add(view, TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT, TINYGLTF_TYPE_SCALAR, count);
}

int AccessorStore::add_positions(const std::vector<glm::vec3>& positions) {
    const int index = add_vec3(positions);
    glm::vec3 lower = positions.at(0), upper = positions.at(0);
    for (const glm::vec3& p : positions) lower = glm::min(lower, p), upper = glm::max(upper, p);
    model_.accessors[index].minValues = {lower.x, lower.y, lower.z};
    model_.accessors[index].maxValues = {upper.x, upper.y, upper.z};
    return index;
}

int AccessorStore::add_vec2(const std::vector<glm::vec2>& values) {
    const int view = add_view(values.data(), values.size() * sizeof(glm::vec2), TINYGLTF_TARGET_ARRAY_BUFFER);
    return add(view, TINYGLTF_COMPONENT_TYPE_FLOAT, TINYGLTF_TYPE_VEC2, values.size());
}

int AccessorStore::add_vec3(const std::vector<glm::vec3>& values) {
    const int view = add_view(values.data(), values.size() * sizeof(glm::vec3), TINYGLTF_TARGET_ARRAY_BUFFER);
    return add(view, TINYGLTF_COMPONENT_TYPE_FLOAT, TINYGLTF_TYPE_VEC3, values.size());
}

int AccessorStore::add_vec4(const std::vector<glm::vec4>& values) {
    const int view = add_view(values.data(), values.size() * sizeof(glm::vec4), TINYGLTF_TARGET_ARRAY_BUFFER);
    return add(view, TINYGLTF_COMPONENT_TYPE_FLOAT, TINYGLTF_TYPE_VEC4, values.size());
}

int AccessorStore::add_times(const std::vector<float>& times_s) {
    const int view = add_view(times_s.data(), times_s.size() * sizeof(float), 0);
    const int index = add(view, TINYGLTF_COMPONENT_TYPE_FLOAT, TINYGLTF_TYPE_SCALAR, times_s.size());
    model_.accessors[index].minValues = {times_s.front()};
    model_.accessors[index].maxValues = {times_s.back()};
    return index;
}

int AccessorStore::add_keys(const std::vector<std::vector<double>>& keys) {
    std::vector<float> values;
    for (const std::vector<double>& key : keys) values.insert(values.end(), key.begin(), key.end());
    const int view = add_view(values.data(), values.size() * sizeof(float), 0);
    const int type = keys.at(0).size() == 4 ? TINYGLTF_TYPE_VEC4 : TINYGLTF_TYPE_VEC3;
    return add(view, TINYGLTF_COMPONENT_TYPE_FLOAT, type, keys.size());
}

std::vector<std::vector<double>> loop_tangents(const std::vector<float>& times_s,
                                               const std::vector<std::vector<double>>& keys) {
    const std::size_t count = keys.size();
    std::vector<std::vector<double>> result;
    for (std::size_t i = 0; i < count; ++i) {
        const bool ends_meet = i == 0 || i + 1 == count;
        const std::size_t before = i == 0 ? count - 2 : i - 1, after = i + 1 == count ? 1 : i + 1;
        const double span_s = ends_meet
                                  ? (times_s[count - 1] - times_s[count - 2]) + (times_s[1] - times_s[0])
                                  : times_s[after] - times_s[before];
        std::vector<double> tangent;
        for (std::size_t c = 0; c < keys[i].size(); ++c)
            tangent.push_back((keys[after][c] - keys[before][c]) / span_s);
        result.insert(result.end(), {tangent, keys[i], tangent});
    }
    return result;
}

}  // namespace tarn::content
