// A scene from a glTF file: what stands where, at one moment. Needs no GL.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "tarn/camera.h"
#include "tarn/values.h"

namespace tarn::api {

struct SceneOptions {
    // Sky: equirectangular linear radiance, an .exr or .hdr file. Empty: none.
    std::filesystem::path environment;
    // Without such a file: an even sky of this radiance. nullopt: 1 where the scene has no light, else 0.
    std::optional<float> sky;
    int scene_index = -1;  // which of the file's scenes; -1: the file's own choice
    double time_s = -1.0;  // as for Scene::move_to
};

// A node of the scene, such as a thing, a lamp or a group of them. Valid for the scene that gave it, as long
// as that is.
struct Node {
    std::uint32_t index = 0xffffffffu;
    bool operator==(const Node&) const = default;
};

enum class LightKind { POINT, SPOT, DIRECTIONAL };

// A light without extent. Its node places it; spots and directional lights shine along the node's -Z.
struct Light {
    LightKind kind = LightKind::POINT;
    Vec3 intensity{1.0, 1.0, 1.0};  // red, green, blue. Point, spot: W/sr; directional: irradiance, W/m^2
    double inner_cone_rad = 0.0;    // spot: from its axis, where it begins to fade
    double outer_cone_rad = 0.7853981633974483;  // and where it ends
    double range_m = 0.0;                        // point, spot: nothing beyond; 0: unlimited
};

// What a material looks like: factors, which textures multiply where the file has them.
struct Surface {
    Vec3 base_color{0.8, 0.8, 0.8};  // linear, 0 to 1
    double roughness = 0.5;          // 0 to 1
    double metallic = 0.0;           // 0 to 1
    Vec3 emission;                   // radiance, W sr^-1 m^-2; 0: it does not shine
};

// The triangles of one mesh on one node: of all that it has of one material.
struct Triangles {
    Node node;
    std::vector<Vec3> corners;  // three a triangle, metres, world space
    bool is_animated = false;   // an animation moves or deforms them
    bool has_holes = false;     // its texture cuts parts out of it, as out of leaves
};

// How much there is in a scene.
struct SceneFacts {
    std::size_t triangles = 0;  // of all instances
    std::size_t instances = 0;
    std::size_t materials = 0;
    std::size_t textures = 0;         // pictures
    std::size_t punctual_lights = 0;  // without extent
    std::size_t light_triangles = 0;  // that shine
    int sky_width_px = 0;             // 0: no sky
    int sky_height_px = 0;
};

// Edits and moves take effect with the next frame of any view of the scene. Movable; views keep what they
// need of it alive.
class Scene {
  public:
    // A file that is there as it is; else the file of one of the project's own scenes, such as lantern_court,
    // which are looked for as docs/embedding.md says. Error where there is neither.
    static std::filesystem::path find_file(const std::filesystem::path& scene);
    // Loads a .gltf or .glb file. Error that names the file and what is wrong with it.
    static Scene load(const std::filesystem::path& file, const SceneOptions& options = {});

    Scene(Scene&& other) noexcept;
    Scene& operator=(Scene&& other) noexcept;
    ~Scene();

    const std::string& name() const;
    // What holds all triangles at the moment for which the scene was loaded, metres, world space.
    Box bounds() const;
    // As the last frame drew it.
    SceneFacts facts() const;

    // ---- Cameras, in the file's order. Where the scene moves them they are as of this moment.
    std::size_t camera_count() const;
    std::string camera_name(std::size_t index) const;
    // Error where there is no such camera, or its node leaves it no direction.
    Camera camera(std::size_t index) const;
    Camera camera(const std::string& name) const;
    // The first one; where there is none, a view of the whole for a picture of this width / height.
    Camera default_camera(double aspect) const;

    // ---- Time. All animations play at once, each in a loop.
    double duration_s() const;  // of the longest animation; 0: nothing moves by itself
    // Moves everything to a moment; < 0: the rest pose. Error for a time that is not finite.
    void move_to(double time_s);

    // ---- Nodes
    std::size_t node_count() const;
    std::string node_name(Node node) const;
    // The first node of that name. Error where there is none.
    Node find_node(const std::string& name) const;
    // Where a node stands in its parent. An animation that moves the node goes first.
    Transform transform(Node node) const;
    // Error for numbers that are not finite.
    void set_transform(Node node, const Transform& transform);

    // ---- Geometry
    // All of it as it stands at this moment. Costs a pass over every triangle.
    std::vector<Triangles> triangles() const;

    // ---- Materials, in the file's order, then those that came later. The same may be on many nodes. These
    // throw Error where there is no such material.
    std::size_t material_count() const;
    std::string material_name(std::size_t material) const;
    // Of a node's triangles; empty where it has none.
    std::vector<std::size_t> materials(Node node) const;
    Surface surface(std::size_t material) const;
    // Error for what is out of its range. Lamps that begin or cease to shine cost more than others: the table
    // of all lights is made anew.
    void set_surface(std::size_t material, const Surface& surface);

    // ---- Things that come and go. Each of these calls makes the next frame of every view build all that the
    // view keeps anew, as after loading: seconds. So let things come before the first frame, and then move
    // them (set_transform) and switch them (set_surface), which is cheap. A thing must not have an extent of
    // 0: to hide one, move it out of sight.
    // Gives a node's triangles materials of their own, so that set_surface changes this node alone.
    void separate_materials(Node node);
    // A new thing on a new node without parent, with a material of its own. The sphere has
    // 20 * 4^subdivisions triangles, each of which is a light where it shines; subdivisions: 0 to 6.
    Node add_sphere(double radius_m, int subdivisions, const Surface& surface, const Transform& transform);
    Node add_box(const Vec3& half_extent_m, const Surface& surface, const Transform& transform);
    // The mesh of a node once more, with the same materials, on a new node without parent. Error where there
    // is none, and where it deforms.
    Node add_copy(Node source, const Transform& transform);
    // Takes its mesh from a node. Error where it has none.
    void remove_mesh(Node node);

    // ---- Lights, known by their nodes. Meshes that shine are no lights in this sense.
    std::vector<Node> lights() const;
    // These throw Error where the node has no light.
    Light light(Node node) const;
    void set_light(Node node, const Light& light);
    void remove_light(Node node);
    // A new light on a new node without parent.
    Node add_light(const Light& light, const Transform& transform);

  private:
    friend struct SceneAccess;
    friend class View;
    explicit Scene(std::shared_ptr<struct SceneState> state);
    std::shared_ptr<struct SceneState> state_;
};

}  // namespace tarn::api
