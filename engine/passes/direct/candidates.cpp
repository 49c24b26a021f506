#include "passes/direct/candidates.h"

#include "shared/interface/bindings.h"
#include "shared/interface/constants/candidates.h"
#include "shared/interface/records.h"
#include "shared/math/reservoir.h"

namespace tarn {

Samples choose_candidates(const FrameContext& frame, const GBuffer& gbuffer, const SampleSlot& slot,
                          const CandidateSources& sources) {
    const DirectPlan& plan = frame.plan.direct;
    const Samples fresh{frame.take_pixel_rows("direct/candidates", RESERVOIR_ROWS, BufferUse::DEVICE),
                        frame.take_pixel_rows("shadow_rays", RAY_ROWS, BufferUse::SHARED)};
    CandidatesConstants constants;
    constants.target_weights = slot.target_weights;
    constants.candidate_count = std::uint32_t(plan.candidate_count);
    constants.sample_index = slot.index;
    PassRecorder pass = frame.pass("direct/candidates");
    if (sources.tiles) pass.read(UNIT_PASS_A, sources.tiles);
    if (sources.brdf_hits) pass.read(UNIT_PASS_B, sources.brdf_hits);
    if (sources.tree != nullptr) pass.read_table(UNIT_PASS_E, *sources.tree);
    read_gbuffer(pass, gbuffer)
        .constants(constants)
        .write(0, fresh.reservoirs)
        .write(1, fresh.rays)
        .count(BLOCK_COUNTERS, frame.counters)
        .dispatch(frame.compute(plan.candidates), frame.size_px);
    return fresh;
}

}  // namespace tarn
