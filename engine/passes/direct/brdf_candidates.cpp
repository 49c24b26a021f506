#include "passes/direct/brdf_candidates.h"

#include "shared/interface/bindings.h"
#include "shared/interface/constants/candidates.h"
#include "shared/interface/records.h"

namespace tarn {

Rows trace_brdf_candidates(const FrameContext& frame, const GBuffer& gbuffer, const SampleSlot& slot,
                           const World& world) {
    const Rows rays = frame.take_pixel_rows("direct/brdf_rays", RAY_ROWS, BufferUse::SHARED);
    const Rows samples = frame.take_pixel_rows("direct/brdf_samples", 1, BufferUse::SHARED);
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
        .write_on_cpu(samples->buffer())
        .run_on_cpu([&] {
            const RayBatchResult result =
                frame.tracer.trace_lights(rays->buffer().mapped<glm::uvec4>(),
                                          samples->buffer().mapped<glm::uvec4>(), world, slot.shadow_key);
            frame.rays.closest += result.traced;
            frame.rays.shadow.rejected += result.rejected;
        });
    return samples;
}

}  // namespace tarn
