// Visibility: shadow rays that a shader wrote, answered by the ray tracer's worker threads in the same
// memory.
#pragma once

#include "frame/frame_recorder.h"
#include "rays/ray_tracer.h"

namespace tarn {

// One answer a ray: 1 where nothing is in the way, else 0.
struct Visibility {
    const Buffer& answers;
    const BufferTexture& texture;  // R32F
};

class VisibilityPass {
  public:
    explicit VisibilityPass(std::size_t ray_count);

    // Traces `rays` (RAY_ROWS rows a ray, SHARED). The only place where GL memory meets the ray tracer.
    Visibility record(FrameRecorder& frame, const RayTracer& tracer, const Buffer& rays,
                      const CoverageKey& key);

    // Rays of the last batch.
    const RayBatchResult& result() const { return result_; }

  private:
    std::size_t ray_count_;
    Buffer answers_;
    BufferTexture texture_;
    RayBatchResult result_;
};

}  // namespace tarn
