// Collects meshes, materials, nodes, cameras, lights and animations, and writes them as one binary glTF 2.0
// file.
#pragma once

#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>
#include <memory>
#include <string>
#include <vector>

#include "content/shapes.h"

namespace tarn::content {

// 8-bit picture, row 0 on top; 3 channels, or 4 with alpha.
struct Picture {
    int width = 0;
    int height = 0;
    int channels = 3;
    std::vector<unsigned char> bytes;  // [height][width][channels]
};

// A material in glTF's terms; -1: no texture. Colours are linear.
struct MaterialSpec {
    std::string name;
    glm::vec3 base_color{1.0f};
    float metallic = 0.0f;
    float roughness = 1.0f;
    float specular = 1.0f;     // 0 makes a dielectric purely diffuse
    glm::vec3 radiance{0.0f};  // emitted, W sr^-1 m^-2
    int base_color_texture = -1;
    int metallic_roughness_texture = -1;
    int normal_texture = -1;
    int emission_texture = -1;
    float texture_repeat_m = 1.0f;  // uv are in metres: one repeat of the textures spans this many
    bool alpha_mask = false;
    bool double_sided = false;
};

struct Placement {
    glm::vec3 translation{0.0f};
    glm::quat rotation{1.0f, 0.0f, 0.0f, 0.0f};
    glm::vec3 scale{1.0f};
};

// The part of a mesh that has one material.
struct Part {
    Shape shape;
    int material = 0;
};

enum class Motion { LINEAR, CUBIC };

class GltfWriter {
  public:
    GltfWriter(const std::string& scene_name, std::uint64_t seed);
    ~GltfWriter();
    GltfWriter(const GltfWriter&) = delete;
    GltfWriter& operator=(const GltfWriter&) = delete;

    // Each returns the new element's index.
    int add_texture(const std::string& name, const Picture& picture);
    int add_material(const MaterialSpec& spec);
    int add_mesh(const std::string& name, const std::vector<Part>& parts);
    int add_node(const std::string& name, const Placement& placement, int mesh = -1, int parent = -1);
    int add_camera(const std::string& name, const glm::vec3& position, const glm::vec3& target,
                   double fov_deg);
    int add_point_light(const std::string& name, const glm::vec3& position, const glm::vec3& color,
                        double intensity);
    int add_directional_light(const std::string& name, const glm::vec3& towards, const glm::vec3& color,
                              double irradiance);

    // Adds a channel to the scene's one animation. `keys` has one entry for each time; for a CUBIC motion
    // tangents are those of a smooth loop through the keys (the last key must equal the first).
    void animate_translation(int node, Motion motion, const std::vector<float>& times_s,
                             const std::vector<glm::vec3>& keys);
    void animate_rotation(int node, Motion motion, const std::vector<float>& times_s,
                          const std::vector<glm::quat>& keys);

    // The finished .glb file as bytes. Throws Error if it would not fit glTF's 4 GB.
    std::string to_bytes();

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

// Writes bytes to a file. Throws Error naming the file.
void write_file(const std::string& path, const std::string& bytes);

}  // namespace tarn::content
