#include "passes/direct/brdf_candidates.h"

#include "passes/trace_rays.h"
#include "shared/interface/constants/candidates.h"
#include "shared/interface/records.h"

namespace tarn {

Rows trace_brdf_candidates(const FrameContext& frame, const GBuffer& gbuffer, const SampleSlot& slot) {
    const Rows rays = frame.take_pixel_rows("direct/brdf_rays", RAY_ROWS, BufferUse::SHARED);
    CandidatesConstants constants{};
    constants.target_weights = slot.target_weights;
    constants.sample_index = slot.index;
    {
        PassRecorder pass = frame.pass("direct/brdf_rays");
        read_gbuffer(pass, gbuffer)
            .constants(constants)
            .write(0, rays)
            .dispatch(frame.compute(BrdfRaysVariant{}), frame.size_px);
    }
    return trace_closest_hits(frame, "direct/brdf_hits", rays, frame.pixel_count(), slot.shadow_key);
}

}  // namespace tarn
