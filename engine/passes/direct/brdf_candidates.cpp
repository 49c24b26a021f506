#include "passes/direct/brdf_candidates.h"

#include "shared/interface/bindings.h"
#include "shared/interface/constants/candidates.h"
#include "shared/interface/records.h"

namespace tarn {

Rows trace_brdf_candidates(const FrameContext& frame, const GBuffer& gbuffer, const SampleSlot& slot) {
    const Rows rays = frame.take_pixel_rows("direct/brdf_rays", RAY_ROWS, BufferUse::SHARED);
    const Rows hits = frame.take_pixel_rows("direct/brdf_hits", HIT_ROWS, BufferUse::SHARED);
    CandidatesConstants constants{};
    constants.target_weights = glm::vec4(slot.target_weights, 0.0f);
    constants.sample_index = slot.index;
    {
        PassRecorder pass = frame.pass("direct/brdf_rays");
        read_gbuffer(pass, gbuffer)
            .constants(constants)
            .write(0, rays)
            .dispatch(frame.compute(BrdfRaysVariant{}), frame.size_px);
    }
    frame.pass("direct/brdf_hits")
        .read_on_cpu(rays->buffer())
        .write_on_cpu(hits->buffer())
        .run_on_cpu([&] {
            const RayBatchResult result =
                frame.tracer.trace_closest_hits(rays->buffer().mapped<glm::uvec4>(),
                                                hits->buffer().mapped<glm::uvec4>(), slot.shadow_key);
            frame.rays.closest += result.traced;
            frame.rays.shadow.rejected += result.rejected;
        });
    return hits;
}

}  // namespace tarn
