// Puts vertex data, indices and animation keys into a tinygltf model's buffer, each with its view and
// accessor.
#pragma once

#include <tiny_gltf.h>

#include <cstddef>
#include <glm/glm.hpp>
#include <vector>

namespace tarn::content {

// Every function appends to model.buffers[0] and returns the new accessor's index (add_view: the view's).
class AccessorStore {
  public:
    explicit AccessorStore(tinygltf::Model& model) : model_(model) {}

    // `target`: TINYGLTF_TARGET_..., or 0 for data that is neither vertices nor indices.
    int add_view(const void* data, std::size_t size_bytes, int target);

    // 16-bit indices where they suffice, else 32-bit.
    int add_triangles(const std::vector<glm::uvec3>& triangles, std::size_t vertex_count);

    // As vec3, with the bounds that glTF asks for.
    int add_positions(const std::vector<glm::vec3>& positions);
    int add_vec2(const std::vector<glm::vec2>& values);
    int add_vec3(const std::vector<glm::vec3>& values);
    int add_vec4(const std::vector<glm::vec4>& values);

    // Key times of an animation, with their bounds.
    int add_times(const std::vector<float>& times_s);
    // Key values of 3 or 4 components.
    int add_keys(const std::vector<std::vector<double>>& keys);

  private:
    int add(int view, int component_type, int type, std::size_t count);

    tinygltf::Model& model_;
};

// CUBICSPLINE keys (in tangent, value, out tangent) of a smooth closed loop through `keys`, whose last key
// equals the first; tangents by central differences.
std::vector<std::vector<double>> loop_tangents(const std::vector<float>& times_s,
                                               const std::vector<std::vector<double>>& keys);

}  // namespace tarn::content
