// The public scene: triangles, surfaces, and things that come and go.
#include <algorithm>

#include "api/guard.h"
#include "api/scene_checks.h"
#include "api/shapes.h"

namespace tarn::api {
namespace {

constexpr int SUBDIVISIONS_LIMIT = 6;  // 81 920 triangles

tarn::Material& find_material(SceneState& state, std::size_t index) {
    const std::size_t count = state.scene.materials.size();
    if (index >= count) throw Error(fmt::format("material {}: the scene has {}", index, count));
    return state.scene.materials[index];
}

void check_share(const char* name, double value) {
    if (value >= 0.0 && value <= 1.0) return;
    throw Error(fmt::format("a surface's {} is {}: it must be 0 to 1", name, value));
}

void check_surface(const Surface& surface) {
    for (const double value : {surface.base_color.x, surface.base_color.y, surface.base_color.z})
        check_share("base colour", value);
    check_share("roughness", surface.roughness);
    check_share("metallic", surface.metallic);
    const Vec3& e = surface.emission;
    if (!is_finite(e) || std::min({e.x, e.y, e.z}) < 0.0) {
        throw Error(fmt::format("a surface's emission is {}, {}, {}: it must be finite and not below 0", e.x,
                                e.y, e.z));
    }
}

// Alpha and textures stay what they are.
void write_surface(tarn::Material& material, const Surface& surface) {
    const glm::vec3 color(from_public(surface.base_color));
    material.base_color = glm::vec4(color, material.base_color.a);
    material.roughness = float(surface.roughness);
    material.metallic = float(surface.metallic);
    material.emission = glm::vec3(from_public(surface.emission));
}

std::vector<tarn::Instance> instances_of(const tarn::Scene& scene, Node node) {
    std::vector<tarn::Instance> list;
    std::copy_if(scene.instances.begin(), scene.instances.end(), std::back_inserter(list),
                 [&](const tarn::Instance& instance) { return instance.node == NodeIndex(node.index); });
    return list;
}

Node add_node(SceneState& state, const std::string& kind, const Transform& transform) {
    tarn::Node node;
    node.name = fmt::format("{} {}", kind, state.scene.nodes.size());
    node.local = checked_transform(transform);
    state.scene.nodes.push_back(std::move(node));
    return {std::uint32_t(state.scene.nodes.size() - 1)};
}

Node add_mesh(SceneState& state, const std::string& kind, Mesh mesh, const Surface& surface,
              const Transform& transform) {
    check_surface(surface);
    const Node node = add_node(state, kind, transform);
    tarn::Scene& scene = state.scene;
    mesh.name = kind;
    mesh.material = MaterialIndex(scene.materials.size());
    scene.materials.emplace_back().name = scene.nodes[node.index].name;
    write_surface(scene.materials.back(), surface);
    scene.instances.push_back({MeshIndex(scene.meshes.size()), NodeIndex(node.index), {}});
    scene.meshes.push_back(std::move(mesh));
    note_rebuild(state);
    return node;
}

// Which nodes an animation moves, themselves or by a parent.
std::vector<bool> find_animated(const tarn::Scene& scene) {
    std::vector<bool> has_channel(scene.nodes.size(), false);
    for (const Animation& animation : scene.animations) {
        for (const AnimationChannel& channel : animation.channels) has_channel[channel.node.value] = true;
    }
    std::vector<bool> is_animated(scene.nodes.size(), false);
    for (std::size_t i = 0; i < scene.nodes.size(); ++i) {
        for (NodeIndex up(i); up.is_set(); up = at(scene.nodes, up).parent)
            is_animated[i] = is_animated[i] || has_channel[up.value];
    }
    return is_animated;
}

Triangles place_triangles(const tarn::Scene& scene, const tarn::Instance& instance, const Pose& pose) {
    const Mesh& mesh = at(scene.meshes, instance.mesh);
    Triangles result;
    result.node = {instance.node.value};
    result.has_holes = at(scene.materials, mesh.material).alpha_mode == AlphaMode::MASK;
    const glm::dmat4 place = origin_from_object(scene, instance, pose, glm::dvec3(0.0));
    std::vector<glm::vec3> deformed;
    if (mesh.deforms()) deformed = deform_mesh(scene, instance, pose, glm::dvec3(0.0)).positions_os;
    const std::vector<glm::vec3>& positions = mesh.deforms() ? deformed : mesh.positions_os;
    result.corners.reserve(3 * mesh.triangles.size());
    for (const glm::uvec3& triangle : mesh.triangles) {
        for (int corner = 0; corner < 3; ++corner) {
            const glm::dvec4 position(glm::dvec3(positions[triangle[corner]]), 1.0);
            result.corners.push_back(to_public(glm::dvec3(place * position)));
        }
    }
    return result;
}

}  // namespace

std::vector<Triangles> Scene::triangles() const {
    return guard([&] {
        const tarn::Scene& scene = state_->scene;
        const Pose pose = evaluate_pose(scene, state_->time_s);
        const std::vector<bool> is_animated = find_animated(scene);
        std::vector<Triangles> list;
        for (const tarn::Instance& instance : scene.instances) {
            list.push_back(place_triangles(scene, instance, pose));
            const Mesh& mesh = at(scene.meshes, instance.mesh);
            list.back().is_animated = is_animated[instance.node.value] || mesh.deforms();
        }
        return list;
    });
}

std::size_t Scene::material_count() const {
    return state_->scene.materials.size();
}

std::string Scene::material_name(std::size_t material) const {
    return find_material(*state_, material).name;
}

std::vector<std::size_t> Scene::materials(Node node) const {
    find_node_of(*state_, node);
    std::vector<std::size_t> list;
    for (const tarn::Instance& instance : instances_of(state_->scene, node))
        list.push_back(at(state_->scene.meshes, instance.mesh).material.value);
    return list;
}

Surface Scene::surface(std::size_t material) const {
    const tarn::Material& source = find_material(*state_, material);
    return {to_public(glm::dvec3(source.base_color)), double(source.roughness), double(source.metallic),
            to_public(glm::dvec3(source.emission))};
}

void Scene::set_surface(std::size_t material, const Surface& surface) {
    tarn::Material& edited = find_material(*state_, material);
    check_surface(surface);
    write_surface(edited, surface);
    note_edit(*state_);
}

void Scene::separate_materials(Node node) {
    find_node_of(*state_, node);
    tarn::Scene& scene = state_->scene;
    for (tarn::Instance& instance : scene.instances) {
        if (instance.node != NodeIndex(node.index)) continue;
        Mesh mesh = at(scene.meshes, instance.mesh);
        tarn::Material material = at(scene.materials, mesh.material);
        mesh.material = MaterialIndex(scene.materials.size());
        scene.materials.push_back(std::move(material));
        instance.mesh = MeshIndex(scene.meshes.size());
        scene.meshes.push_back(std::move(mesh));
    }
    note_rebuild(*state_);
}

Node Scene::add_sphere(double radius_m, int subdivisions, const Surface& surface,
                       const Transform& transform) {
    if (!(radius_m > 0.0 && radius_m <= 1e6))
        throw Error(fmt::format("a sphere's radius is {} m: it must be above 0 and at most 1e6", radius_m));
    if (subdivisions < 0 || subdivisions > SUBDIVISIONS_LIMIT) {
        throw Error(fmt::format("a sphere's subdivisions are {}: they must be 0 to {}", subdivisions,
                                SUBDIVISIONS_LIMIT));
    }
    return guard(
        [&] { return add_mesh(*state_, "sphere", make_sphere(radius_m, subdivisions), surface, transform); });
}

Node Scene::add_box(const Vec3& half_extent_m, const Surface& surface, const Transform& transform) {
    const Vec3& h = half_extent_m;
    if (!is_finite(h) || std::min({h.x, h.y, h.z}) <= 0.0 || std::max({h.x, h.y, h.z}) > 1e6) {
        throw Error(fmt::format("a box's half extent is {}, {}, {} m: each must be above 0 and at most 1e6",
                                h.x, h.y, h.z));
    }
    return guard(
        [&] { return add_mesh(*state_, "box", make_box(from_public(half_extent_m)), surface, transform); });
}

Node Scene::add_copy(Node source, const Transform& transform) {
    const std::string name = find_node_of(*state_, source).name;
    std::vector<tarn::Instance> copies = instances_of(state_->scene, source);
    if (copies.empty()) throw Error(fmt::format("node {} '{}' has no mesh", source.index, name));
    for (const tarn::Instance& instance : copies) {
        if (!at(state_->scene.meshes, instance.mesh).deforms()) continue;
        throw Error(fmt::format("node {} '{}' deforms: it cannot be copied", source.index, name));
    }
    const Node node = add_node(*state_, name, transform);
    for (tarn::Instance& copy : copies) {
        copy.node = NodeIndex(node.index);
        state_->scene.instances.push_back(copy);
    }
    note_rebuild(*state_);
    return node;
}

void Scene::remove_mesh(Node node) {
    const std::string name = find_node_of(*state_, node).name;
    const std::size_t removed = std::erase_if(state_->scene.instances, [&](const tarn::Instance& instance) {
        return instance.node == NodeIndex(node.index);
    });
    if (removed == 0) throw Error(fmt::format("node {} '{}' has no mesh", node.index, name));
    note_rebuild(*state_);
}

}  // namespace tarn::api
