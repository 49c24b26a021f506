// What the next frame may look back to. Besides these the scene's tables keep the rows of the last frame
// (GpuScene).
#pragma once

#include <vector>

#include "frame/history.h"
#include "passes/antialias/antialias.h"
#include "passes/average.h"
#include "passes/denoise/denoise.h"
#include "passes/exposure.h"
#include "passes/gbuffer.h"
#include "passes/indirect/cache.h"
#include "passes/reuse/samples.h"
#include "rays/ray_tracer.h"

namespace tarn {

struct FrameHistory {
    std::optional<PreviousRays> rays;  // which the last frame was; none: there is nothing to look back at
    CameraRecord camera{};
    glm::vec2 jitter_px{0.0f};
    History<Surfaces> surfaces;
    History<Exposure> exposure;
    History<AveragedFrames> averaged;
    History<Picture> shown;                      // as it was shown, or would have been
    std::vector<History<KeptSamples>> direct;    // one a target
    std::vector<History<KeptSamples>> indirect;  // the same
    bool paths_may_be_stale = false;  // something has changed since their lamps were asked for (tests_lamps)
    History<Picture> indirect_light;  // of the base, without its albedo: what paths find in view
    History<CacheCells> cache_cells;
    History<Surfaces> coarse_surfaces;  // of indirect light on a coarse picture
    History<KeptLight> denoised;
    History<KeptPicture> picture;  // of the size of the output

    void forget() { *this = {}; }
    // All but what is shown, as where frames get another size. Rays and camera stay those of the last frame.
    void forget_frame() {
        FrameHistory kept;
        kept.rays = rays;
        kept.camera = camera;
        kept.jitter_px = jitter_px;
        kept.exposure = exposure;
        kept.shown = shown;
        kept.picture = picture;
        *this = std::move(kept);
    }
};

// What the last frame saw, where this one follows it.
template <class T>
std::optional<Previous<T>> find_previous(const FrameContext& frame, const History<T>& history) {
    if (!frame.previous) return std::nullopt;
    return history.of_frame(frame.previous->key.frame);
}

}  // namespace tarn
