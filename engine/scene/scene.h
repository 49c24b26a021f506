// The scene as plain tables: what glTF said, checked, in linear units, with no rendering in it.
//
// Spaces: os = object space of a mesh, ns = space of a node's parent, ws = world space. Right-handed, +Y up,
// metres. Node transforms are doubles, so that a scene 1e5 m from the origin keeps its millimetres; renderers
// work relative to `World::origin_ws` (scene/world.h).
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/index.h"

namespace tarn {

using MeshIndex = Index<struct MeshTag>;
using MaterialIndex = Index<struct MaterialTag>;
using TextureIndex = Index<struct TextureTag>;
using ImageIndex = Index<struct ImageTag>;
using NodeIndex = Index<struct NodeTag>;
using SkinIndex = Index<struct SkinTag>;
using CameraIndex = Index<struct CameraTag>;
using LightIndex = Index<struct LightTag>;

struct Bounds {
    glm::dvec3 lower{1e300};
    glm::dvec3 upper{-1e300};

    bool empty() const { return lower.x > upper.x; }
    void add(const glm::dvec3& point) {
        lower = glm::min(lower, point);
        upper = glm::max(upper, point);
    }
    void add(const Bounds& other) {
        lower = glm::min(lower, other.lower);
        upper = glm::max(upper, other.upper);
    }
    glm::dvec3 centre() const { return 0.5 * (lower + upper); }
    glm::dvec3 extent() const { return upper - lower; }
};

// ---- Geometry
// -------------------------------------------------------------------------------------------------------

// Displacements of one morph target; an empty vector means "none of this attribute".
struct MorphTarget {
    std::vector<glm::vec3> positions_os;
    std::vector<glm::vec3> normals_os;
    std::vector<glm::vec3> tangents_os;
};

// One glTF primitive as an indexed triangle list. All attribute vectors are empty or as long as positions_os;
// normals are never empty (generated flat where the file has none), tangents are filled where a normal map
// needs them.
struct Mesh {
    std::string name;
    std::vector<glm::vec3> positions_os;
    std::vector<glm::vec3> normals_os;
    std::vector<glm::vec4> tangents_os;  // w = handedness, +1 or -1
    std::vector<glm::vec2> uv0;
    std::vector<glm::vec2> uv1;
    std::vector<glm::vec4> colors;  // linear, multiplies base colour
    std::vector<glm::uvec3> triangles;
    MaterialIndex material;  // unset: the default material, which import appends and sets
    Bounds bounds_os;

    std::vector<MorphTarget> morph_targets;
    // Skinning influences, 4 or 8 a vertex: joints[k * vertex_count + v] for set k.
    int influence_sets = 0;
    std::vector<glm::u16vec4> joints;
    std::vector<glm::vec4> weights;

    bool deforms() const { return !morph_targets.empty() || influence_sets > 0; }
};

// ---- Materials and textures
// -----------------------------------------------------------------------------------------

// Texels as the renderer and the CPU both see them: RGBA, 16 bits each, unsigned normalized, LINEAR (sRGB
// decoded at import), row 0 on top as in glTF.
struct TextureImage {
    std::string name;
    int width = 0;
    int height = 0;
    std::vector<glm::u16vec4> texels;  // [height][width]
};

enum class Wrap : std::uint32_t { REPEAT = 0, CLAMP = 1, MIRROR = 2 };

struct Texture {
    ImageIndex image;
    Wrap wrap_u = Wrap::REPEAT;
    Wrap wrap_v = Wrap::REPEAT;
    bool nearest = false;  // magnification filter
};

// A texture as one material slot uses it (KHR_texture_transform included): uv' = offset + rotate(rotation) *
// scale * uv, counter-clockwise as seen with v pointing down: rotate(uv) = (c u + s v, c v - s u).
struct TextureSlot {
    TextureIndex texture;  // unset: no texture, value 1 (normal map: +Z)
    int uv_set = 0;        // 0 or 1
    glm::vec2 offset{0.0f};
    glm::vec2 scale{1.0f};
    float rotation_rad = 0.0f;
};

enum class AlphaMode : std::uint32_t { OPAQUE = 0, MASK = 1, BLEND = 2 };

struct Material {
    std::string name;
    glm::vec4 base_color{1.0f};  // linear
    float metallic = 1.0f;
    float roughness = 1.0f;
    float normal_scale = 1.0f;
    float specular = 1.0f;           // KHR_materials_specular: scales dielectric F0 and F90
    glm::vec3 specular_color{1.0f};  // KHR_materials_specular: tints dielectric F0
    float ior = 1.5f;                // KHR_materials_ior
    glm::vec3 emission{0.0f};        // radiance, W sr^-1 m^-2: emissiveFactor * emissiveStrength
    AlphaMode alpha_mode = AlphaMode::OPAQUE;
    float alpha_cutoff = 0.5f;
    bool double_sided = false;
    bool unlit = false;
    TextureSlot base_color_map;          // RGB base colour, A alpha
    TextureSlot metallic_roughness_map;  // G roughness, B metallic
    TextureSlot normal_map;
    TextureSlot emission_map;
};

// ---- Nodes, instances, skins
// ----------------------------------------------------------------------------------------

struct Transform {
    glm::dvec3 translation{0.0};
    glm::dquat rotation{1.0, 0.0, 0.0, 0.0};
    glm::dvec3 scale{1.0};
};

struct Node {
    std::string name;
    NodeIndex parent;                  // unset for a root; a parent's index may be larger than its child's
    Transform local;                   // rest pose; ignored where `matrix` is set
    std::optional<glm::dmat4> matrix;  // ns_from_node, where the file gave a matrix instead of TRS
    std::vector<float> morph_weights;  // rest weights of the node's mesh
    CameraIndex camera;
    LightIndex light;
};

// A mesh placed in the world by a node. Instances are in node order, then in primitive order.
struct Instance {
    MeshIndex mesh;
    NodeIndex node;
    SkinIndex
        skin;  // set: the skin's joints place the vertices in ws and the node's own transform is ignored
};

struct Skin {
    std::vector<NodeIndex> joints;
    std::vector<glm::dmat4> joint_from_mesh;  // inverse bind matrices, as many as joints
};

// ---- Cameras and lights
// ---------------------------------------------------------------------------------------------

// Looks along its node's -Z, +Y up.
struct Camera {
    std::string name;
    bool orthographic = false;
    double vertical_fov_rad = 0.8;
    double half_height_m = 1.0;  // orthographic alone (ymag)
    NodeIndex node;              // the node that places it
};

enum class LightKind : std::uint32_t { POINT = 0, SPOT = 1, DIRECTIONAL = 2 };

// KHR_lights_punctual; photometric units are taken as radiometric ones.
struct PunctualLight {
    std::string name;
    LightKind kind = LightKind::POINT;
    glm::vec3 intensity{1.0f};  // point, spot: W/sr; directional: irradiance, W/m^2
    double inner_cone_rad = 0.0;
    double outer_cone_rad = 0.7853981633974483;
    double range_m = 0.0;  // 0: unlimited
};

// ---- Animation
// ------------------------------------------------------------------------------------------------------

enum class Interpolation { STEP, LINEAR, CUBIC };
enum class AnimatedProperty { TRANSLATION, ROTATION, SCALE, WEIGHTS };

struct AnimationChannel {
    NodeIndex node;
    AnimatedProperty property = AnimatedProperty::TRANSLATION;
    Interpolation interpolation = Interpolation::LINEAR;
    std::vector<float> times_s;  // strictly increasing
    // [key][component], 3, 4 (xyzw) or target count components; CUBIC: [key][in tangent, value, out
    // tangent][component]
    std::vector<float> values;
    int components = 3;
};

struct Animation {
    std::string name;
    std::vector<AnimationChannel> channels;
    double duration_s = 0.0;
};

// ---- The whole
// ------------------------------------------------------------------------------------------------------

// Which nodes were moved, in order. A reader remembers how many it has followed.
class NodeMoves {
  public:
    void add(NodeIndex node) { nodes_.push_back(node); }
    // Forgets what all readers have followed; one that has not looks at the whole scene again.
    void clear() {
        first_ += nodes_.size();
        nodes_.clear();
    }
    // Moves ever made.
    std::uint64_t count() const { return first_ + nodes_.size(); }
    // Those after the first `followed`; nullopt where they are forgotten.
    std::optional<std::span<const NodeIndex>> since(std::uint64_t followed) const {
        if (followed < first_ || followed > count()) return std::nullopt;
        return std::span(nodes_).subspan(std::size_t(followed - first_));
    }

  private:
    std::uint64_t first_ = 0;
    std::vector<NodeIndex> nodes_;
};

struct Scene {
    std::string name;
    std::vector<Mesh> meshes;
    std::vector<Material> materials;
    std::vector<Texture> textures;
    std::vector<TextureImage> images;
    std::vector<Node> nodes;
    std::vector<Instance> instances;
    std::vector<Skin> skins;
    std::vector<Camera> cameras;
    std::vector<PunctualLight> lights;
    std::vector<NodeIndex> light_nodes;  // nodes of the scene that carry a light, in node order
    std::vector<Animation> animations;
    // To be increased by whoever edits a table, so that update_world looks for the edit. Nodes and instances
    // keep their indices: lights are known by them.
    std::uint64_t revision = 0;
    // Instead of that, where nothing but nodes' transforms was edited: an update then looks at them alone.
    NodeMoves moves;

    std::vector<std::string> extensions_used;          // as the file lists them
    std::vector<std::string> extensions_honoured;      // those of them that Tarn reads
    std::vector<std::string> extensions_approximated;  // those that it reads, but shows as something simpler
    std::vector<std::string> extensions_ignored;       // those that it does not read
};

}  // namespace tarn
