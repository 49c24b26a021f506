// One path: from a pixel into the scene, gathering light on its way.
#pragma once

#include "reference/reference.h"
#include "world/scene_access.h"

namespace tarn {

// Draws paths. Cheap to make; one for each task.
class PathIntegrator {
  public:
    // `light_tree`: up to date where the settings draw from it.
    PathIntegrator(const World& world, const LightTree& light_tree, const RayTracer& tracer,
                   const ReferenceSettings& settings);

    // Radiance of sample number `sample` of the pixel in `column` and `row`. A pure function of these and the
    // seed.
    glm::vec3 sample_radiance(int column, int row, std::uint32_t sample);

    std::uint64_t rays() const { return rays_; }

  private:
    // Where a path stands: the surface just reached, and what it needs for the next step.
    struct Vertex {
        Surface surface;
        Frame frame;
        BrdfView brdf;
    };

    struct BrdfSample {
        glm::vec3 direction;
        glm::vec3 weight;  // BRDF * cosine / pdf; 0 ends the path
        float pdf_solid_angle;
    };

    RayRecord make_camera_ray(int column, int row) const;
    std::optional<Hit> trace(const RayRecord& ray, std::uint32_t ray_kind, BackFaces back_faces);
    Vertex make_vertex(const Hit& hit, const glm::vec3& direction);
    const Vertex& find_first_vertex(const Hit& hit, const glm::vec3& direction);
    // False where the surface emits nothing, whatever its side and textures.
    bool may_emit(const Hit& hit);
    glm::vec3 gather_path(Vertex vertex);

    SceneAccess::LightCandidate draw_light(const ShadingPoint& point, std::uint32_t dimension);
    float light_probability(const ShadingPoint& point, std::uint32_t light);
    glm::vec3 sample_direct_light(const Vertex& vertex, std::uint32_t dimension);
    BrdfSample sample_direction(const Vertex& vertex, const glm::vec3& u) const;
    glm::vec3 weigh_sky(const glm::vec3& direction, float pdf_brdf);
    glm::vec3 weigh_emission(const Vertex& from, const Vertex& to, const Hit& hit, float pdf_brdf);
    float light_pdf_solid_angle(const ShadingPoint& point, const Hit& hit);

    float weigh_light_sample(float pdf_light, float pdf_brdf) const;
    float weigh_brdf_sample(float pdf_brdf, float pdf_light) const;

    const World& world_;
    const RayTracer& tracer_;
    const ReferenceSettings& settings_;
    SceneAccess scene_;
    RandomKey key_{};
    std::uint64_t rays_ = 0;

    struct FirstVertex {
        Hit hit;  // of no instance before the first path
        glm::vec3 direction{0.0f};
        Vertex vertex{};
    };
    FirstVertex first_;  // of the last path that met anything
};

}  // namespace tarn
