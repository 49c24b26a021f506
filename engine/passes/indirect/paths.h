// Indirect light, first steps: a path from each pixel, surface by surface.
#pragma once

#include "passes/gbuffer.h"
#include "passes/indirect/cache.h"
#include "passes/reflected_light.h"
#include "passes/reuse/samples.h"

namespace tarn {

// The pixels' paths with their last shadow rays answered (shaders/lib/indirect/path_state.glsl).
struct Paths {
    Rows states;
    Rows answers;
    Rows light_hits;                        // of rays from their ends; null: none were sent
    const RowBuffer* light_tree = nullptr;  // from which their lamps were drawn; null: by power
};

// What paths draw from; null where the plan does not ask for it.
struct PathSources {
    const RowBuffer* blue_noise = nullptr;  // the mask
    const RowBuffer* light_tree = nullptr;
    PathCache cache;  // of what lies beyond the last surface
};

// Traces `frame.plan.indirect.bounces` surfaces far. Rays of the first leg meet partly covered surfaces by
// `slot.shadow_key`, as the rays that later test the samples do: what one has seen the other sees.
Paths trace_paths(const FrameContext& frame, const GBuffer& gbuffer, const SampleSlot& slot,
                  const PathSources& sources);

// A fresh sample of each path.
Samples finish_samples(const FrameContext& frame, const GBuffer& gbuffer, const SampleSlot& slot,
                       const Paths& paths);

// The light of the paths themselves, where nothing is reused.
ReflectedLight finish_light(const FrameContext& frame, const GBuffer& gbuffer, const SampleSlot& slot,
                            const Paths& paths);

}  // namespace tarn
