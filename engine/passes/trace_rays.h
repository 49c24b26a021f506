// Rays that a shader wrote, answered by the ray tracer's worker threads in the same memory: the one place
// where GL memory meets the tracer.
#pragma once

#include <string>

#include "passes/frame_context.h"

namespace tarn {

// One float a ray: 1 where nothing is in the way, else 0.
using Answers = Rows;

// What each pixel sees (GBuffer::seen), by a ray each.
Picture trace_primary(const FrameContext& frame, const CameraRecord& camera);

// Traces the first `ray_count` of `rays` (RAY_ROWS rows a ray, SHARED) as pass `name`. Rays flagged
// RAY_PREVIOUS are answered as the last frame would have answered them.
Answers trace_visibility(const FrameContext& frame, const std::string& name, const Rows& rays,
                         std::size_t ray_count, const CoverageKey& key);

// The same for what rays meet first: HIT_ROWS rows a ray (HitRecord).
Rows trace_closest_hits(const FrameContext& frame, const std::string& name, const Rows& rays,
                        std::size_t ray_count, const CoverageKey& key);

}  // namespace tarn
