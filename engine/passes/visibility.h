// Visibility: shadow rays that a shader wrote, answered by the ray tracer's worker threads in the same
// memory.
#pragma once

#include <string>

#include "frame/frame_recorder.h"
#include "rays/ray_tracer.h"

namespace tarn {

class VisibilityPass {
  public:
    explicit VisibilityPass(std::size_t ray_capacity);

    // Traces the first `ray_count` of `rays` (RAY_ROWS rows a ray, SHARED) as pass `name`. Returns one float
    // a ray: 1 where nothing is in the way, else 0. Rays flagged RAY_PREVIOUS are answered by `previous`.
    const RowBuffer& record(FrameRecorder& frame, const std::string& name, const RayTracer& tracer,
                            const Buffer& rays, std::size_t ray_count, const CoverageKey& key,
                            const PreviousRays& previous = {});

    const RowBuffer& answers() const { return answers_; }

    // Rays of the last batch.
    const RayBatchResult& result() const { return result_; }

  private:
    RowBuffer answers_;
    RayBatchResult result_;
};

}  // namespace tarn
