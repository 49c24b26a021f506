// The ray tracer as the rest of the engine sees it. Embree stays behind this interface.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>

#include "shared/interface/records.h"
#include "world/world.h"

namespace tarn {

struct Hit {
    std::uint32_t instance = INVALID_INDEX;
    std::uint32_t primitive = INVALID_INDEX;  // within the mesh
    glm::vec2 barycentrics{0.0f};             // weights of the second and third vertex
    float t = 0.0f;                           // in units of the ray's |direction|
};

// What decides stochastic coverage (alpha BLEND) besides the ray's own pixel; see random_coverage in
// shaders/shared/math/random.h.
struct CoverageKey {
    std::uint32_t frame = 0;
    std::uint32_t seed = 0;
    std::uint32_t ray = 0;  // RAY_CAMERA, RAY_SHADOW, ...
};

// Single-sided surfaces seen from behind: camera rays pass through them, as the rasterizer's do
// (glTF 2.0, 3.9.6); all other rays meet them.
enum class BackFaces { HIT, PASS };

struct RayBatchResult {
    std::uint64_t traced = 0;
    std::uint64_t rejected =
        0;  // not finite or without direction: answered "occluded", never given to the tracer
};

class RayTracer {
  public:
    virtual ~RayTracer() = default;

    // Follows the world: rebuilds meshes that deformed, moves instances. Must be called after the world
    // changed and before the next ray. `world` must outlive the tracer.
    virtual void update(const World& world) = 0;

    // The nearest covered hit in (0, max_t), if any. Thread-safe.
    virtual std::optional<Hit> trace_closest(const RayRecord& ray, const CoverageKey& key,
                                             BackFaces back_faces = BackFaces::HIT) const = 0;

    // Whether nothing covers (0, max_t). Inactive rays are visible, rejected ones are not. Thread-safe.
    bool is_visible(const RayRecord& ray, const CoverageKey& key) const;

    // Traces a batch on the worker threads: `ray_rows` holds RAY_ROWS rows a ray, `visibility` gets 1
    // (nothing in the way, or inactive ray) or 0 a ray. Both may be memory that GL shares. Same answers for
    // any number of threads.
    RayBatchResult trace_visibility(std::span<const glm::uvec4> ray_rows, std::span<float> visibility,
                                    const CoverageKey& key) const;

    // Where rays end, as light samples: traces a batch on the worker threads, `ray_rows` as above;
    // `sample_rows` gets one row a ray: (light, uv as bits, 0), light being an index of `world.lights`,
    // LIGHT_ENVIRONMENT for rays that leave the scene where there is a sky, or INVALID_INDEX. Same answers
    // for any number of threads.
    RayBatchResult trace_lights(std::span<const glm::uvec4> ray_rows, std::span<glm::uvec4> sample_rows,
                                const World& world, const CoverageKey& key) const;

  private:
    // The same for a ray that was checked: finite, with a direction, and active.
    virtual bool is_unoccluded(const RayRecord& ray, const CoverageKey& key) const = 0;
};

// Worker threads for ray tracing and the reference: at most `threads` for the life of this object (0: one per
// core).
class WorkerLimit {
  public:
    explicit WorkerLimit(int threads);
    ~WorkerLimit();
    WorkerLimit(const WorkerLimit&) = delete;
    WorkerLimit& operator=(const WorkerLimit&) = delete;

  private:
    struct State;
    std::unique_ptr<State> state_;
};

// Embree 3, two-level: one BVH per mesh, instances on top. Throws Error when Embree fails.
std::unique_ptr<RayTracer> create_embree_tracer(const World& world);

// The ray tracing library and its version, such as "3.13.5".
std::string describe_ray_library();

// Tests every triangle for every ray. The oracle for tests.
std::unique_ptr<RayTracer> create_brute_force_tracer(const World& world);

}  // namespace tarn
