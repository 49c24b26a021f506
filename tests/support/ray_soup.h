// Triangles, instances and rays at random, for tests of ray tracers.
#pragma once

#include <random>
#include <vector>

#include "shared/math/random.h"
#include "support/toy_scenes.h"

namespace tarn::test {

using Rng = std::mt19937;

inline glm::vec3 random_point(Rng& rng, float half_size) {
    std::uniform_real_distribution<float> u(-half_size, half_size);
    const float x = u(rng), y = u(rng), z = u(rng);
    return {x, y, z};
}

inline std::vector<glm::vec3> random_triangles(Rng& rng, int count) {
    std::vector<glm::vec3> corners;
    for (int i = 0; i < count; ++i) {
        const glm::vec3 centre = random_point(rng, 1.0f);
        for (int c = 0; c < 3; ++c) corners.push_back(centre + random_point(rng, 0.6f));
    }
    return corners;
}

// Instances in every kind of transform: plain, turned, mirrored, stretched, flattened.
inline void add_random_instances(ToyScene& toy, Rng& rng, MeshIndex mesh) {
    const glm::dvec3 scales[] = {{1, 1, 1}, {-1, 1, 1}, {0.3, 2, 1}, {-1, -1, -2}, {1.5, 1, 0}};
    for (const glm::dvec3& scale : scales) {
        const glm::dvec3 axis = glm::normalize(glm::dvec3(random_point(rng, 1.0f)) + glm::dvec3(0, 0, 1.1));
        glm::dmat4 m = glm::translate(glm::dmat4(1.0), glm::dvec3(random_point(rng, 2.0f)));
        m = glm::scale(glm::rotate(m, 2.0, axis), scale);
        toy.add_instance(mesh, m);
    }
}

inline Material striped_material(ToyScene& toy, AlphaMode mode) {
    TextureImage image;
    image.width = image.height = 4;
    for (int i = 0; i < 16; ++i) image.texels.emplace_back(65535, 65535, 65535, (i * 40503) % 65536);
    toy.scene.images.push_back(image);
    Texture texture;
    texture.image = ImageIndex(toy.scene.images.size() - 1);
    toy.scene.textures.push_back(texture);
    Material material;
    material.alpha_mode = mode;
    material.double_sided = mode == AlphaMode::BLEND;
    material.base_color_map.texture = TextureIndex(toy.scene.textures.size() - 1);
    return material;
}

inline void add_random_uvs(Mesh& mesh, Rng& rng) {
    for (std::size_t v = 0; v < mesh.positions_os.size(); ++v) {
        const glm::vec3 p = random_point(rng, 2.0f);
        mesh.uv0.emplace_back(p.x, p.y);
    }
}

inline World make_soup(bool with_alpha) {
    Rng rng(7);
    ToyScene toy;
    Material two_sided;
    two_sided.double_sided = true;
    const std::vector<Material> materials = {Material{}, two_sided, striped_material(toy, AlphaMode::MASK),
                                             striped_material(toy, AlphaMode::BLEND)};
    for (std::size_t m = 0; m < (with_alpha ? 4u : 2u); ++m) {
        const MaterialIndex material = toy.add_material(materials[m]);
        const MeshIndex mesh = toy.add_mesh(material, random_triangles(rng, 40));
        add_random_uvs(at(toy.scene.meshes, mesh), rng);
        add_random_instances(toy, rng, mesh);
    }
    return build_world(toy.scene);
}

inline RayRecord random_ray(Rng& rng, std::uint32_t pixel) {
    std::uniform_real_distribution<float> u(0.0f, 1.0f);
    RayRecord ray;
    ray.origin = random_point(rng, 4.0f);
    ray.direction = random_point(rng, 2.0f) - ray.origin;
    const bool unlimited = u(rng) < 0.3f;
    ray.max_t = unlimited ? RAY_INFINITY : 1.5f * u(rng);
    ray.pixel = pixel;
    return ray;
}

inline std::vector<glm::uvec4> pack_rays(const std::vector<RayRecord>& rays) {
    std::vector<glm::uvec4> rows(rays.size() * RAY_ROWS);
    for (std::size_t i = 0; i < rays.size(); ++i) pack_ray(rays[i], rows[2 * i], rows[2 * i + 1]);
    return rows;
}

}  // namespace tarn::test
