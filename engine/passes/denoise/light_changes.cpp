#include "passes/denoise/light_changes.h"

#include "passes/trace_rays.h"
#include "shared/interface/bindings.h"
#include "shared/interface/constants/light_changes.h"
#include "shared/interface/records.h"
#include "shared/math/random.h"

namespace tarn {

Picture find_light_changes(const FrameContext& frame, const GBuffer& gbuffer,
                           const Previous<KeptSamples>& previous, const KeptSamples& present) {
    const glm::ivec2 cells = (frame.size_px + CHANGE_CELL - 1) / CHANGE_CELL;
    const std::size_t rays_count = std::size_t(cells.x) * std::size_t(cells.y) * CHANGE_RAYS;
    const bool traces = frame.plan.denoise.light_samples.asks_rays;
    const LightChangeConstants constants{std::uint32_t(cells.x), std::uint32_t(cells.y), traces ? 1u : 0u};
    const Picture values = frame.recorder.take_picture("denoise/light_samples", cells, GL_RGBA32F);
    Rows rays;
    if (traces) {
        rays = frame.recorder.take_rows("denoise/light_rays", rays_count * RAY_ROWS * sizeof(glm::uvec4),
                                        BufferUse::SHARED);
    }
    {
        PassRecorder pass = frame.pass("denoise/light_samples");
        read_gbuffer(pass, gbuffer)
            .constants(constants)
            .read(UNIT_PASS_A, previous, previous.value().reservoirs)
            .read(UNIT_PASS_B, present.reservoirs)
            .write_image(0, *values);
        if (rays) pass.write(0, rays);
        pass.dispatch(frame.compute(frame.plan.denoise.light_samples), cells);
    }
    Answers answers;
    if (rays) {
        const CoverageKey key{frame.frame, frame.seed, RAY_SHADOW};
        answers = trace_visibility(frame, "denoise/light_rays", rays, rays_count, key);
    }
    const Picture changes = frame.recorder.take_picture("denoise/light_changes", cells, GL_R32F);
    PassRecorder pass = frame.pass("denoise/light_changes");
    pass.constants(constants).read(UNIT_PASS_A, values).write_image(0, *changes);
    if (answers) pass.read(UNIT_PASS_B, answers);
    pass.dispatch(frame.compute(LightChangesVariant{}), cells);
    return changes;
}

}  // namespace tarn
