// The oracle: every ray against every triangle of every instance, in world space and in double precision.
#include <cmath>

#include "rays/geometry_revisions.h"
#include "rays/ray_checks.h"
#include "rays/ray_tracer.h"

namespace tarn {
namespace {

struct TriangleHit {
    double t = 0.0;
    glm::dvec2 barycentrics{0.0};
    bool front = false;
};

// Moller and Trumbore, "Fast, Minimum Storage Ray-Triangle Intersection", 1997, in doubles.
std::optional<TriangleHit> intersect(const glm::dvec3 corners[3], const glm::dvec3& origin,
                                     const glm::dvec3& direction, bool mirrored) {
    const glm::dvec3 edge1 = corners[1] - corners[0], edge2 = corners[2] - corners[0];
    const glm::dvec3 p = glm::cross(direction, edge2);
    const double determinant = glm::dot(edge1, p);
    if (determinant == 0.0) return std::nullopt;
    const glm::dvec3 to_origin = origin - corners[0];
    const glm::dvec3 q = glm::cross(to_origin, edge1);
    TriangleHit hit;
    hit.barycentrics = glm::dvec2(glm::dot(to_origin, p), glm::dot(direction, q)) / determinant;
    hit.t = glm::dot(edge2, q) / determinant;
    const bool inside = hit.barycentrics.x >= 0.0 && hit.barycentrics.y >= 0.0 &&
                        hit.barycentrics.x + hit.barycentrics.y <= 1.0;
    if (!inside || hit.t < 0.0) return std::nullopt;
    const double towards = glm::dot(glm::cross(edge1, edge2), direction);
    hit.front = mirrored ? towards >= 0.0 : towards <= 0.0;
    return hit;
}

class BruteForceTracer : public RayTracer {
  public:
    explicit BruteForceTracer(const World& world) : present_(world), previous_(world) {}

    void update(const World& world) override {
        if (geometry_revisions_of(world) == geometry_revisions_of(present_)) return;
        previous_ = std::move(present_);
        present_ = world;
        ++revision_;
    }

    std::uint64_t geometry_revision() const override { return revision_; }

    std::optional<Hit> trace_closest(const RayRecord& ray, const CoverageKey& key,
                                     BackFaces back_faces) const override {
        return classify_ray(ray) == RayState::TRACEABLE ? trace_world(present_, ray, key, back_faces)
                                                        : std::nullopt;
    }

  private:
    bool is_unoccluded(const RayRecord& ray, const CoverageKey& key, Moment moment) const override {
        const World& world = moment == Moment::PRESENT ? present_ : previous_;
        return !trace_world(world, ray, key, BackFaces::HIT).has_value();
    }

    static std::optional<Hit> trace_world(const World& world, const RayRecord& ray, const CoverageKey& key,
                                          BackFaces back_faces) {
        std::optional<Hit> nearest;
        RayRecord shortened = ray;
        for (std::uint32_t i = 0; i < world.instances.size(); ++i) {
            if (const auto hit = trace_instance(world, i, shortened, key, back_faces)) {
                nearest = hit;
                shortened.max_t = hit->t;
            }
        }
        return nearest;
    }

    static std::optional<Hit> trace_instance(const World& world, std::uint32_t index, const RayRecord& ray,
                                             const CoverageKey& key, BackFaces back_faces) {
        const WorldInstance& instance = world.instances[index];
        const WorldMesh& mesh = world.meshes[instance.mesh];
        const glm::dmat4 transform(instance.world_from_object);
        const bool single_sided = (world.flags_of(index) & MATERIAL_DOUBLE_SIDED) == 0u;
        std::optional<Hit> nearest;
        for (std::uint32_t primitive = 0; primitive < mesh.triangle_count; ++primitive) {
            const glm::uvec3 triangle = world.triangles[mesh.first_triangle + primitive];
            glm::dvec3 corners[3];
            for (int c = 0; c < 3; ++c) {
                const std::size_t row = std::size_t(mesh.first_vertex + triangle[c]) * VERTEX_ROWS;
                corners[c] = transform * glm::dvec4(row_xyz(world.vertex_rows[row]), 1.0);
            }
            const auto hit = intersect(corners, ray.origin, ray.direction, instance.mirrored);
            if (!hit || hit->t > double(nearest ? nearest->t : ray.max_t)) continue;
            if (back_faces == BackFaces::PASS && single_sided && !hit->front) continue;
            const glm::vec2 barycentrics(hit->barycentrics);
            if (!is_hit_covered(world, world.material_rows, key, ray.pixel, index, primitive, barycentrics))
                continue;
            nearest = Hit{index, primitive, barycentrics, float(hit->t)};
        }
        return nearest;
    }

    // Copies: the world itself changes in place.
    World present_;
    World previous_;
    std::uint64_t revision_ = 0;
};

}  // namespace

std::unique_ptr<RayTracer> create_brute_force_tracer(const World& world) {
    return std::make_unique<BruteForceTracer>(world);
}

}  // namespace tarn
