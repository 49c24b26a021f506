// Random scenes of lights of all kinds, for tests of what draws among them.
#pragma once

#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

#include "support/draws.h"
#include "support/toy_scenes.h"

namespace tarn::test {

// Lights of all kinds in clusters within a few metres of the origin; intensities over six decades.
class LightScene {
  public:
    explicit LightScene(std::uint64_t seed) : draws_(seed) {}

    ToyScene& toy() { return toy_; }
    Scene& scene() { return toy_.scene; }
    Draws& draws() { return draws_; }

    void add_punctual(LightKind kind) {
        PunctualLight light;
        light.kind = kind;
        light.intensity = draw_color();
        light.outer_cone_rad = draws_.uniform(0.02, 1.57);
        light.inner_cone_rad = light.outer_cone_rad * draws_.uniform(0.0, 0.98);
        toy_.add_light(light, draw_transform());
    }

    // A mesh of small triangles; some are two-sided, some mirrored.
    void add_triangles(int count) {
        Material material = emissive_material(draw_color());
        material.double_sided = draws_.uniform() < 0.3;
        const MaterialIndex index = toy_.add_material(material);
        std::vector<vec3> corners;
        for (int i = 0; i < count; ++i) {
            const vec3 place = vec3(draw_place());
            const float size = float(std::pow(10.0, draws_.uniform(-3.0, 0.0)));
            for (int c = 0; c < 3; ++c) corners.push_back(place + size * draws_.unit_vector());
        }
        glm::dmat4 transform = draw_transform();
        if (draws_.uniform() < 0.3) transform = glm::scale(transform, glm::dvec3(-1.0, 1.0, 1.0));
        toy_.add_instance(toy_.add_mesh(index, corners), transform);
    }

    // `count` lights or so: triangles, points, spots and, where asked for, directional ones.
    void add_lights(int count, bool directional) {
        for (int i = 0; i < count / 4; ++i) {
            add_punctual(i % 2 == 0 ? LightKind::POINT : LightKind::SPOT);
        }
        for (int i = 0; i < 3; ++i) add_triangles(count / 4);
        if (directional) {
            for (int i = 0; i < 2; ++i) add_punctual(LightKind::DIRECTIONAL);
        }
    }

    glm::dvec3 draw_place() {
        return {draws_.uniform(-4.0, 4.0), draws_.uniform(-4.0, 4.0), draws_.uniform(-4.0, 4.0)};
    }

  private:
    vec3 draw_color() { return vec3(float(std::pow(10.0, draws_.uniform(-3.0, 3.0)))); }
    glm::dmat4 draw_transform() {
        const glm::dmat4 moved = glm::translate(glm::dmat4(1.0), draw_place());
        return glm::rotate(moved, draws_.uniform(0.0, 6.28), glm::dvec3(draws_.unit_vector()));
    }

    ToyScene toy_;
    Draws draws_;
};

}  // namespace tarn::test
