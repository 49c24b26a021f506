// Batches of rays over the worker threads. Each ray is answered alone, so the answers know nothing of
// threads.
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <atomic>

#include "core/error.h"
#include "rays/flush_denormals.h"
#include "rays/ray_checks.h"
#include "rays/ray_tracer.h"

namespace tarn {
namespace {

// Enough rays to drown the cost of a task, few enough to keep all threads busy to the end.
constexpr std::size_t RAYS_PER_TASK = 512;

}  // namespace

bool RayTracer::is_visible(const RayRecord& ray, const CoverageKey& key, Moment moment) const {
    const RayState state = classify_ray(ray);
    return state == RayState::TRACEABLE ? is_unoccluded(ray, key, moment) : state == RayState::INACTIVE;
}

namespace {

// Runs `answer(ray, state, index)` for each ray, on all workers.
template <class Answer>
RayBatchResult for_each_ray(std::span<const glm::uvec4> ray_rows, const Answer& answer) {
    std::atomic<std::uint64_t> traced{0}, rejected{0};
    const auto trace_range = [&](const tbb::blocked_range<std::size_t>& range) {
        const FlushDenormals flush;
        RayBatchResult local;
        for (std::size_t i = range.begin(); i != range.end(); ++i) {
            const RayRecord ray = unpack_ray(ray_rows[i * RAY_ROWS], ray_rows[i * RAY_ROWS + 1]);
            const RayState state = classify_ray(ray);
            local.traced += state == RayState::TRACEABLE;
            local.rejected += state == RayState::REJECTED;
            answer(ray, state, i);
        }
        traced += local.traced;
        rejected += local.rejected;
    };
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, ray_rows.size() / RAY_ROWS, RAYS_PER_TASK),
                      trace_range);
    return {traced, rejected};
}

HitRecord record_hit(const RayRecord& ray, const Hit& hit) {
    return {hit.instance, hit.primitive, hit.barycentrics, ray.direction, hit.t};
}

}  // namespace

RayBatchResult RayTracer::trace_visibility(std::span<const glm::uvec4> ray_rows, std::span<float> visibility,
                                           const CoverageKey& key, const PreviousRays& previous) const {
    TARN_ASSERT(ray_rows.size() == visibility.size() * RAY_ROWS, "{} ray rows for {} answers",
                ray_rows.size(), visibility.size());
    // Where nothing changed since, the last frame's geometry is the present one.
    const Moment previous_moment =
        previous.geometry_revision == geometry_revision() ? Moment::PRESENT : Moment::PREVIOUS;
    const bool remembered = remembers(previous.geometry_revision);
    return for_each_ray(ray_rows, [&](RayRecord ray, RayState state, std::size_t i) {
        bool visible = state == RayState::INACTIVE;
        if (state == RayState::TRACEABLE && (ray.pixel & RAY_PREVIOUS) != 0u) {
            TARN_ASSERT(remembered, "rays of geometry {}, the tracer is at {}", previous.geometry_revision,
                        geometry_revision());
            ray.pixel &= ~RAY_PREVIOUS;
            visible = is_unoccluded(ray, previous.key, previous_moment);
        } else if (state == RayState::TRACEABLE) {
            visible = is_unoccluded(ray, key, Moment::PRESENT);
        }
        visibility[i] = visible ? 1.0f : 0.0f;
    });
}

RayBatchResult RayTracer::trace_closest_hits(std::span<const glm::uvec4> ray_rows,
                                             std::span<glm::uvec4> hit_rows, const CoverageKey& key) const {
    TARN_ASSERT(ray_rows.size() / RAY_ROWS == hit_rows.size() / HIT_ROWS, "{} ray rows for {} hit rows",
                ray_rows.size(), hit_rows.size());
    return for_each_ray(ray_rows, [&](const RayRecord& ray, RayState state, std::size_t i) {
        const bool traced = state == RayState::TRACEABLE;
        const auto hit = traced ? trace_closest(ray, key) : std::nullopt;
        pack_hit(hit ? record_hit(ray, *hit) : no_hit(ray.direction, traced), hit_rows[i * HIT_ROWS],
                 hit_rows[i * HIT_ROWS + 1]);
    });
}

}  // namespace tarn
