// Batches of shadow rays over the worker threads. Each ray is answered alone, so the answers know nothing of
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

bool RayTracer::is_visible(const RayRecord& ray, const CoverageKey& key) const {
    const RayState state = classify_ray(ray);
    return state == RayState::TRACEABLE ? is_unoccluded(ray, key) : state == RayState::INACTIVE;
}

RayBatchResult RayTracer::trace_visibility(std::span<const glm::uvec4> ray_rows, std::span<float> visibility,
                                           const CoverageKey& key) const {
    TARN_ASSERT(ray_rows.size() == visibility.size() * RAY_ROWS, "{} ray rows for {} answers",
                ray_rows.size(), visibility.size());
    std::atomic<std::uint64_t> traced{0}, rejected{0};
    const auto trace_range = [&](const tbb::blocked_range<std::size_t>& range) {
        const FlushDenormals flush;
        RayBatchResult local;
        for (std::size_t i = range.begin(); i != range.end(); ++i) {
            const RayRecord ray = unpack_ray(ray_rows[i * RAY_ROWS], ray_rows[i * RAY_ROWS + 1]);
            const RayState state = classify_ray(ray);
            local.traced += state == RayState::TRACEABLE;
            local.rejected += state == RayState::REJECTED;
            const bool visible =
                state == RayState::TRACEABLE ? is_unoccluded(ray, key) : state == RayState::INACTIVE;
            visibility[i] = visible ? 1.0f : 0.0f;
        }
        traced += local.traced;
        rejected += local.rejected;
    };
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, visibility.size(), RAYS_PER_TASK), trace_range);
    return {traced, rejected};
}

}  // namespace tarn
