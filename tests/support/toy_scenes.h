// Small scenes written in code, for tests that know the answer.
#pragma once

#include <glm/gtc/matrix_transform.hpp>
#include <initializer_list>
#include <vector>

#include "scene/scene.h"
#include "world/world.h"

namespace tarn {

// A Lambert material without a specular layer: the BRDF is albedo / pi.
inline Material lambert_material(const glm::vec3& albedo) {
    Material m;
    m.base_color = glm::vec4(albedo, 1.0f);
    m.metallic = 0.0f;
    m.roughness = 1.0f;
    m.specular = 0.0f;
    return m;
}

// Black, and emitting `radiance` from its front.
inline Material emissive_material(const glm::vec3& radiance) {
    Material m = lambert_material(glm::vec3(0.0f));
    m.emission = radiance;
    return m;
}

// A sky of the same radiance everywhere.
inline WorldOptions even_sky(const glm::vec3& radiance) {
    WorldOptions options;
    options.environment = Image(16, 8, 3);
    for (std::size_t i = 0; i < options.environment->pixel_count(); ++i) {
        for (std::size_t c = 0; c < 3; ++c) options.environment->values[i * 3 + c] = radiance[int(c)];
    }
    return options;
}

// Builds a Scene table by table. Vertices are not shared between triangles, so that normals are flat.
class ToyScene {
  public:
    MaterialIndex add_material(const Material& material) {
        scene.materials.push_back(material);
        return MaterialIndex(scene.materials.size() - 1);
    }

    // `corners`: three a triangle, counter-clockwise from the front.
    MeshIndex add_mesh(MaterialIndex material, const std::vector<glm::vec3>& corners) {
        Mesh mesh;
        mesh.material = material;
        for (std::size_t i = 0; i + 2 < corners.size(); i += 3) {
            const glm::vec3 cross = glm::cross(corners[i + 1] - corners[i], corners[i + 2] - corners[i]);
            const float length = glm::length(cross);
            const glm::vec3 normal = length > 0.0f ? cross / length : glm::vec3(0.0f, 1.0f, 0.0f);
            mesh.triangles.emplace_back(i, i + 1, i + 2);
            for (std::size_t c = 0; c < 3; ++c) {
                mesh.positions_os.push_back(corners[i + c]);
                mesh.normals_os.push_back(normal);
                mesh.bounds_os.add(corners[i + c]);
            }
        }
        scene.meshes.push_back(std::move(mesh));
        return MeshIndex(scene.meshes.size() - 1);
    }

    void add_instance(MeshIndex mesh, const glm::dmat4& world_from_object = glm::dmat4(1.0)) {
        Instance instance;
        instance.mesh = mesh;
        instance.node = add_node(world_from_object);
        scene.instances.push_back(instance);
    }

    // A parallelogram: origin, then the two edges; its front is where edge1 x edge2 points.
    void add_quad(MaterialIndex material, const glm::vec3& origin, const glm::vec3& edge1,
                  const glm::vec3& edge2) {
        add_instance(add_mesh(material, {origin, origin + edge1, origin + edge1 + edge2, origin,
                                         origin + edge1 + edge2, origin + edge2}));
    }

    // A light at `position`; spot and directional ones shine along -Z of `world_from_node`.
    void add_light(const PunctualLight& light, const glm::dmat4& world_from_node) {
        scene.lights.push_back(light);
        const NodeIndex node = add_node(world_from_node);
        at(scene.nodes, node).light = LightIndex(scene.lights.size() - 1);
        scene.light_nodes.push_back(node);
    }

    Scene scene;

  private:
    NodeIndex add_node(const glm::dmat4& world_from_node) {
        Node node;
        node.matrix = world_from_node;
        scene.nodes.push_back(node);
        return NodeIndex(scene.nodes.size() - 1);
    }
};

// Corners of a sphere around the origin, with 2 * bands sectors.
inline std::vector<glm::vec3> sphere_corners(float radius, int bands) {
    const auto point = [&](int band, int sector) {
        const double theta = 3.14159265358979 * band / bands, phi = 3.14159265358979 * sector / bands;
        return radius * glm::vec3(glm::dvec3(std::sin(theta) * std::sin(phi), std::cos(theta),
                                             std::sin(theta) * std::cos(phi)));
    };
    std::vector<glm::vec3> corners;
    for (int band = 0; band < bands; ++band) {
        for (int sector = 0; sector < 2 * bands; ++sector) {
            const glm::vec3 a = point(band, sector), b = point(band + 1, sector);
            const glm::vec3 c = point(band + 1, sector + 1), d = point(band, sector + 1);
            if (band + 1 < bands) corners.insert(corners.end(), {a, b, c});
            if (band > 0) corners.insert(corners.end(), {a, c, d});
        }
    }
    return corners;
}

// A white point light.
inline PunctualLight make_point(float intensity) {
    PunctualLight light;
    light.intensity = glm::vec3(intensity);
    return light;
}

inline glm::dmat4 at_place(double x, double y, double z) {
    return glm::translate(glm::dmat4(1.0), glm::dvec3(x, y, z));
}

}  // namespace tarn
