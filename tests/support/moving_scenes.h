// Small scenes in which something changes every frame: what lights, what is lit, what stands between.
//
// Each is a function of the frame number, so that every seed sees the same motion and arrives at the same
// last frame, for which there is one reference. The floor fills the picture: no part of it is dark.
#pragma once

#include <cmath>
#include <functional>
#include <glm/gtc/matrix_transform.hpp>

#include "support/toy_scenes.h"

namespace tarn::test {

// The frame that is compared; motion passes through its place there.
constexpr int LAST_FRAME = 6;

struct MovingScene {
    Scene scene;
    std::function<void(Scene&, int frame)> pose;  // puts everything where it is in that frame
    WorldOptions options;
    glm::dvec3 camera_ws{0.0, 2.6, 2.9};
    glm::dvec3 target_ws{0.0, 0.0, 0.1};
};

// ---- Parts

inline NodeIndex last_node(const ToyScene& toy) {
    return NodeIndex(toy.scene.nodes.size() - 1);
}

inline glm::dmat4 place_at(const glm::dvec3& position, const glm::dvec3& scale = glm::dvec3(1.0),
                           double turn_rad = 0.0) {
    glm::dmat4 m = glm::translate(glm::dmat4(1.0), position);
    m = glm::rotate(m, turn_rad, glm::dvec3(0.3, 1.0, 0.2));
    return glm::scale(m, scale);
}

inline void put(Scene& scene, NodeIndex node, const glm::dmat4& world_from_node) {
    at(scene.nodes, node).matrix = world_from_node;
    ++scene.revision;
}

inline Material glossy_material(const glm::vec3& albedo, float roughness) {
    Material m = lambert_material(albedo);
    m.roughness = roughness;
    m.specular = 1.0f;
    return m;
}

inline Material blended(Material material, float alpha) {
    material.alpha_mode = AlphaMode::BLEND;
    material.base_color.a = alpha;
    return material;
}

// A floor under a wide, dim lamp that lights all of it.
inline ToyScene make_lit_floor(const Material& material = lambert_material(glm::vec3(0.7f, 0.6f, 0.5f))) {
    ToyScene toy;
    toy.add_quad(toy.add_material(material), {-6, 0, 6}, {12, 0, 0}, {0, 0, -12});
    toy.add_quad(toy.add_material(emissive_material(glm::vec3(1.0f, 1.2f, 1.5f))), {-1.5f, 4, -1.5f},
                 {3, 0, 0}, {0, 0, 3});
    return toy;
}

inline NodeIndex add_ball(ToyScene& toy, const Material& material, float radius) {
    toy.add_instance(toy.add_mesh(toy.add_material(material), sphere_corners(radius, 4)));
    return last_node(toy);
}

// A quad around the origin, its front towards -Y, with texture coordinates.
inline MeshIndex add_hanging_quad(ToyScene& toy, const Material& material, float half_size) {
    const float h = half_size;
    const MeshIndex index = toy.add_mesh(
        toy.add_material(material), {{-h, 0, -h}, {h, 0, -h}, {h, 0, h}, {-h, 0, -h}, {h, 0, h}, {-h, 0, h}});
    for (const glm::vec3& p : at(toy.scene.meshes, index).positions_os) {
        at(toy.scene.meshes, index).uv0.emplace_back(0.5f + 0.5f * p.x / h, 0.5f + 0.5f * p.z / h);
    }
    return index;
}

// Bright in one corner, dim in the others, no two channels alike.
inline TextureIndex add_spotted_texture(ToyScene& toy) {
    TextureImage image;
    image.width = image.height = 4;
    for (int i = 0; i < 16; ++i) {
        const bool bright = i % 4 < 2 && i / 4 < 2;
        image.texels.emplace_back(bright ? 65535 : 6000, bright ? 50000 : 9000, 4000 * (i % 7), 65535);
    }
    toy.scene.images.push_back(image);
    Texture texture;
    texture.image = ImageIndex(toy.scene.images.size() - 1);
    toy.scene.textures.push_back(texture);
    return TextureIndex(toy.scene.textures.size() - 1);
}

// ---- Scenes

// A glowing ball, a ball that it lights and one that stands in its light, all moving by `step_m` a frame.
inline MovingScene make_moving_things(double step_m, const Material& floor) {
    ToyScene toy = make_lit_floor(floor);
    const NodeIndex lamp = add_ball(toy, emissive_material(glm::vec3(5.0f, 3.0f, 1.5f)), 0.25f);
    const NodeIndex lit = add_ball(toy, lambert_material(glm::vec3(0.8f)), 0.35f);
    const NodeIndex blocker = add_ball(toy, lambert_material(glm::vec3(0.3f, 0.5f, 0.7f)), 0.2f);
    MovingScene moving;
    moving.scene = std::move(toy.scene);
    moving.pose = [=](Scene& scene, int frame) {
        const double way_m = step_m * (frame - LAST_FRAME);
        put(scene, lamp, place_at({way_m, 0.5, -0.2}));
        put(scene, lit, place_at({-1.0, 0.35, 0.2 + way_m}));
        put(scene, blocker, place_at({0.6 - 0.7 * way_m, 0.25, 0.4 + 0.7 * way_m}, glm::dvec3(1.0), way_m));
    };
    return moving;
}

// A lamp that grows (or shrinks) by `rate` a frame, and turns.
inline MovingScene make_breathing_lamp(double rate) {
    ToyScene toy = make_lit_floor();
    const NodeIndex lamp = add_ball(toy, emissive_material(glm::vec3(9.0f, 6.0f, 3.0f)), 0.25f);
    add_ball(toy, lambert_material(glm::vec3(0.8f)), 0.3f);
    put(toy.scene, last_node(toy), place_at({-0.9, 0.3, 0.5}));
    MovingScene moving;
    moving.scene = std::move(toy.scene);
    moving.pose = [=](Scene& scene, int frame) {
        const int left = frame - LAST_FRAME;
        put(scene, lamp, place_at({0.3, 0.6, 0.0}, glm::dvec3(std::pow(1.0 + rate, left)), 0.1 * left));
    };
    return moving;
}

// A lamp and a receiver that morph, and a blocker that a skin bends: none of their transforms changes.
inline MovingScene make_deforming_things() {
    ToyScene toy = make_lit_floor();
    const auto add_morphing_ball = [&](const Material& material, float radius, const glm::vec3& stretch,
                                       const glm::dvec3& position) {
        const NodeIndex node = add_ball(toy, material, radius);
        Mesh& mesh = toy.scene.meshes.back();
        MorphTarget target;
        for (const glm::vec3& p : mesh.positions_os) target.positions_os.push_back(p * stretch);
        mesh.morph_targets.push_back(target);
        put(toy.scene, node, place_at(position));
        return node;
    };
    const NodeIndex lamp = add_morphing_ball(emissive_material(glm::vec3(9.0f, 6.0f, 3.0f)), 0.25f,
                                             {1.0f, 0.2f, 0.5f}, {0.2, 0.5, -0.2});
    const NodeIndex lit =
        add_morphing_ball(lambert_material(glm::vec3(0.8f)), 0.35f, {-0.2f, 0.3f, 0.5f}, {-1.0, 0.35, 0.2});
    add_ball(toy, lambert_material(glm::vec3(0.3f, 0.5f, 0.7f)), 0.2f);
    Mesh& bent = toy.scene.meshes.back();
    bent.influence_sets = 1;
    for (const glm::vec3& p : bent.positions_os) {
        const float upper = glm::clamp(0.5f + 2.5f * p.y, 0.0f, 1.0f);
        bent.joints.emplace_back(0, 1, 0, 0);
        bent.weights.emplace_back(1.0f - upper, upper, 0.0f, 0.0f);
    }
    const NodeIndex lower(toy.scene.nodes.size()), upper(toy.scene.nodes.size() + 1);
    toy.scene.nodes.resize(toy.scene.nodes.size() + 2);
    toy.scene.skins.push_back({{lower, upper}, {glm::dmat4(1.0), glm::dmat4(1.0)}});
    toy.scene.instances.back().skin = SkinIndex(0);
    MovingScene moving;
    moving.scene = std::move(toy.scene);
    moving.pose = [=](Scene& scene, int frame) {
        const int left = frame - LAST_FRAME;
        at(scene.nodes, lamp).morph_weights = {0.5f + 0.04f * float(left)};
        at(scene.nodes, lit).morph_weights = {0.8f + 0.1f * float(left)};
        put(scene, lower, place_at({0.7, 0.25, 0.4}));
        put(scene, upper,
            place_at({0.7 + 0.06 * left, 0.25, 0.4 - 0.05 * left}, glm::dvec3(1.0), 0.1 * left));
    };
    return moving;
}

// Lamps that are half there over a glossy floor, one of them fading, and a veil before them, fading too; all
// move by 2 cm a frame. The lamps face down, where the camera does not see them: whether a pixel shows one
// would be noise.
inline MovingScene make_fading_veils() {
    ToyScene toy = make_lit_floor(glossy_material(glm::vec3(0.5f), 0.35f));
    const Material glow = emissive_material(glm::vec3(4.0f, 3.5f, 3.0f));
    const MaterialIndex fading(toy.scene.materials.size());
    toy.add_instance(add_hanging_quad(toy, blended(glow, 0.5f), 0.4f));
    const NodeIndex lamp = last_node(toy);
    toy.add_instance(add_hanging_quad(toy, blended(glow, 0.25f), 0.4f));
    const NodeIndex pane = last_node(toy);
    const MaterialIndex veil_material(toy.scene.materials.size());
    Material veil = blended(lambert_material(glm::vec3(0.6f)), 0.5f);
    veil.double_sided = true;
    toy.add_instance(add_hanging_quad(toy, veil, 0.5f));
    const NodeIndex veil_node = last_node(toy);
    MovingScene moving;
    moving.scene = std::move(toy.scene);
    moving.pose = [=](Scene& scene, int frame) {
        const int left = frame - LAST_FRAME;
        const double way_m = 0.02 * left;
        at(scene.materials, fading).base_color.a = 0.5f + 0.05f * float(left);
        at(scene.materials, veil_material).base_color.a = 0.6f - 0.05f * float(left);
        put(scene, lamp, place_at({-0.7 + way_m, 0.5, 0.0}, glm::dvec3(1.0), 0.2));
        put(scene, pane, place_at({0.7, 0.7 + way_m, 0.0}));
        put(scene, veil_node, place_at({-0.5 - way_m, 0.2, 0.3}, glm::dvec3(1.0), 0.3));
    };
    return moving;
}

// Lamps with an emission map, one of them seen through a mirroring transform, that move and turn.
inline MovingScene make_textured_lamps() {
    ToyScene toy = make_lit_floor();
    Material glow = emissive_material(glm::vec3(14.0f, 14.0f, 14.0f));
    glow.emission_map.texture = add_spotted_texture(toy);
    glow.emission_map.rotation_rad = 0.5f;
    toy.add_instance(add_hanging_quad(toy, glow, 0.4f));
    const NodeIndex plain = last_node(toy);
    toy.add_instance(MeshIndex(toy.scene.meshes.size() - 1));
    const NodeIndex mirrored = last_node(toy);
    MovingScene moving;
    moving.scene = std::move(toy.scene);
    moving.pose = [=](Scene& scene, int frame) {
        const int left = frame - LAST_FRAME;
        put(scene, plain, place_at({-0.8, 0.8, 0.03 * left}, glm::dvec3(1.0), 0.05 * left));
        put(scene, mirrored, place_at({0.8 + 0.03 * left, 0.8, 0.2}, {-1.0, 1.0, 1.2}, 0.4 - 0.05 * left));
    };
    return moving;
}

// Two lamps with an emission map, of which the first is lit in frame 3: the other's rows move in the table.
inline MovingScene make_lamp_that_is_lit() {
    ToyScene toy = make_lit_floor();
    Material glow = emissive_material(glm::vec3(14.0f));
    glow.emission_map.texture = add_spotted_texture(toy);
    const MaterialIndex lit_later(toy.scene.materials.size());
    toy.add_instance(add_hanging_quad(toy, glow, 0.4f), place_at({-0.8, 0.8, 0.0}));
    glow.emission_map.rotation_rad = 0.9f;
    toy.add_instance(add_hanging_quad(toy, glow, 0.4f), place_at({0.8, 0.8, 0.2}));
    MovingScene moving;
    moving.scene = std::move(toy.scene);
    moving.pose = [=](Scene& scene, int frame) {
        at(scene.materials, lit_later).emission = glm::vec3(frame < 3 ? 0.0f : 14.0f);
        ++scene.revision;
    };
    return moving;
}

// Sixty lamps in six colours that circle over a textured, glossy floor, some through a grid with holes.
inline MovingScene make_many_lamps(double turn_rad) {
    ToyScene toy;
    Material tiles = glossy_material(glm::vec3(0.6f), 0.4f);
    tiles.base_color_map.texture = add_spotted_texture(toy);
    toy.add_instance(add_hanging_quad(toy, tiles, 6.0f), place_at({0, 0, 0}, {1.0, -1.0, 1.0}));
    for (glm::vec2& uv : toy.scene.meshes.back().uv0) uv *= 12.0f;
    Material grid = lambert_material(glm::vec3(0.4f));
    grid.alpha_mode = AlphaMode::MASK;
    grid.double_sided = true;
    grid.base_color_map.texture = add_spotted_texture(toy);
    for (int i = 0; i < 16; ++i) toy.scene.images.back().texels[std::size_t(i)].a = (i + i / 4) % 2 * 65535;
    at(toy.scene.textures, grid.base_color_map.texture).nearest = true;
    toy.add_instance(add_hanging_quad(toy, grid, 0.6f), place_at({0.3, 0.4, 0.3}));
    std::vector<NodeIndex> lamps;
    for (int i = 0; i < 60; ++i) {
        const glm::vec3 colour(1.0f + float(i % 2), 1.0f + float(i % 3), 2.0f);
        toy.add_instance(add_hanging_quad(toy, emissive_material(20.0f * colour), 0.05f));
        lamps.push_back(last_node(toy));
    }
    MovingScene moving;
    moving.scene = std::move(toy.scene);
    moving.pose = [=](Scene& scene, int frame) {
        for (int i = 0; i < int(lamps.size()); ++i) {
            const double angle = 2.4 * i + turn_rad * (frame - LAST_FRAME),
                         radius = 0.3 * std::sqrt(double(i));
            put(scene, lamps[std::size_t(i)],
                place_at({radius * std::cos(angle), 1.3 + 0.05 * (i % 5), radius * std::sin(angle)}));
        }
    };
    return moving;
}

// Nothing moves: lamps that are half and a quarter there hang low over a shining floor.
inline MovingScene make_half_lamps() {
    ToyScene toy = make_lit_floor(glossy_material(glm::vec3(0.2f), 0.25f));
    const Material glow = emissive_material(glm::vec3(6.0f, 5.0f, 4.0f));
    toy.add_instance(add_hanging_quad(toy, blended(glow, 0.5f), 0.7f), place_at({-0.8, 0.5, -0.6}));
    toy.add_instance(add_hanging_quad(toy, blended(glow, 0.25f), 0.7f), place_at({0.9, 0.5, -0.6}));
    MovingScene still;
    still.scene = std::move(toy.scene);
    still.pose = [](Scene&, int) {};
    return still;
}

// Nothing moves: two lamps and a ball under a sky that is bright on one side, over a glossy floor.
inline MovingScene make_lamps_under_a_sky() {
    ToyScene toy;
    toy.add_quad(toy.add_material(glossy_material(glm::vec3(0.6f, 0.5f, 0.4f), 0.3f)), {-6, 0, 6}, {12, 0, 0},
                 {0, 0, -12});
    toy.add_instance(add_hanging_quad(toy, emissive_material(glm::vec3(6.0f, 4.0f, 2.0f)), 0.4f),
                     place_at({-0.8, 1.0, 0.0}));
    toy.add_instance(add_hanging_quad(toy, emissive_material(glm::vec3(1.0f, 2.0f, 4.0f)), 0.3f),
                     place_at({0.9, 0.7, 0.2}, glm::dvec3(1.0), 0.4));
    add_ball(toy, lambert_material(glm::vec3(0.7f)), 0.3f);
    put(toy.scene, last_node(toy), place_at({0.1, 0.3, 0.3}));
    MovingScene still;
    still.scene = std::move(toy.scene);
    still.pose = [](Scene&, int) {};
    still.options = even_sky(glm::vec3(0.2f, 0.3f, 0.5f));
    Image& sky = *still.options.environment;
    for (int y = 1; y < 4; ++y) {
        for (int x = 4; x < 7; ++x) sky.values[std::size_t(3 * (y * sky.width + x))] = 3.0f;
    }
    return still;
}

}  // namespace tarn::test
