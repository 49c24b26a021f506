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

// Whose geometry a ray meets: the world's as of the latest update, or as it was before the latest update that
// changed it.
enum class Moment { PRESENT, PREVIOUS };

// How rays of a batch that are flagged RAY_PREVIOUS are answered: as the last frame would have answered them.
struct PreviousRays {
    std::uint64_t geometry_revision = 0;  // RayTracer::geometry_revision of that frame
    CoverageKey key;                      // and what decided coverage in it
};

struct RayBatchResult {
    std::uint64_t traced = 0;
    std::uint64_t rejected =
        0;  // not finite or without direction: answered "occluded", never given to the tracer
};

// The rays of a picture: one through each pixel, `jitter_px` from its centre.
struct CameraRays {
    CameraRecord camera;
    glm::ivec2 size_px{0};
    glm::vec2 jitter_px{0.0f};
};

class RayTracer {
  public:
    virtual ~RayTracer() = default;

    // Follows the world: rebuilds meshes that deformed, moves instances, takes over materials. Must be called
    // after the world changed and before the next ray, best once a frame: the geometry before the latest
    // change is kept for rays of the last frame, no older one. `world` must outlive the tracer.
    virtual void update(const World& world) = 0;

    // Grows with each update that changed what rays meet.
    virtual std::uint64_t geometry_revision() const = 0;

    // Whether rays can still be asked of the geometry of that revision: the present one and the one before.
    bool remembers(std::uint64_t geometry_revision) const {
        return geometry_revision <= this->geometry_revision() &&
               geometry_revision + 1 >= this->geometry_revision();
    }

    // The nearest covered hit in (0, max_t), if any. Thread-safe.
    virtual std::optional<Hit> trace_closest(const RayRecord& ray, const CoverageKey& key,
                                             BackFaces back_faces = BackFaces::HIT) const = 0;

    // Whether nothing covers (0, max_t). Inactive rays are visible, rejected ones are not. Thread-safe.
    bool is_visible(const RayRecord& ray, const CoverageKey& key, Moment moment = Moment::PRESENT) const;

    // Traces a batch on the worker threads: `ray_rows` holds RAY_ROWS rows a ray, `visibility` gets 1
    // (nothing in the way, or inactive ray) or 0 a ray. Both may be memory that GL shares. Same answers for
    // any number of threads. Rays flagged RAY_PREVIOUS are answered by `previous`, whose geometry the tracer
    // must remember.
    RayBatchResult trace_visibility(std::span<const glm::uvec4> ray_rows, std::span<float> visibility,
                                    const CoverageKey& key, const PreviousRays& previous = {}) const;

    // What rays meet first: traces a batch on the worker threads, `ray_rows` as above; `hit_rows` gets
    // HIT_ROWS rows a ray (HitRecord). Both may be memory that GL shares. Same answers for any number of
    // threads.
    RayBatchResult trace_closest_hits(std::span<const glm::uvec4> ray_rows, std::span<glm::uvec4> hit_rows,
                                      const CoverageKey& key) const;

    // What each pixel of a picture sees, as the rasterizer draws it: traces `rays` on the worker threads and
    // gives `seen` instance and primitive a pixel, row by row from the top; INVALID_INDEX where there is
    // nothing. Returns the number of rays. Same answers for any number of threads.
    std::uint64_t trace_camera_rays(const CameraRays& rays, std::span<glm::uvec2> seen,
                                    const CoverageKey& key) const;

  protected:
    // Camera rays that run alike, of neighbouring pixels.
    static constexpr std::size_t PACKET = 8;

    // What the first `count` of them meet first, back faces passed; instance INVALID_INDEX: nothing.
    // Thread-safe.
    virtual void trace_packet(std::span<const RayRecord, PACKET> rays, std::size_t count,
                              const CoverageKey& key, std::span<Hit, PACKET> hits) const;

  private:
    // The same for a ray that was checked: finite, with a direction, and active.
    virtual bool is_unoccluded(const RayRecord& ray, const CoverageKey& key, Moment moment) const = 0;
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

// Embree: one BVH of the triangles of all that stands still, and instances of what moves or deforms. What
// begins to move costs no rebuild. Where things move, a second top level (and a second BVH of each mesh that
// deforms) holds the geometry of the moment before; what stands still is there once. Throws Error when Embree
// fails.
std::unique_ptr<RayTracer> create_embree_tracer(const World& world);

// The ray tracing library and its version, such as "3.13.5".
std::string describe_ray_library();

// Tests every triangle for every ray. The oracle for tests.
std::unique_ptr<RayTracer> create_brute_force_tracer(const World& world);

}  // namespace tarn
