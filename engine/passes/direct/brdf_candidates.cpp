#include "passes/direct/brdf_candidates.h"

#include "shared/interface/bindings.h"
#include "shared/interface/records.h"

namespace tarn {

BrdfCandidatesPass::BrdfCandidatesPass(ProgramLibrary& programs, int width_px, int height_px)
    : programs_(programs),
      width_px_(width_px),
      height_px_(height_px),
      rays_(make_pixel_rows("direct/brdf_rays", width_px, height_px, RAY_ROWS, BufferUse::SHARED)),
      hits_(make_pixel_rows("direct/brdf_hits", width_px, height_px, HIT_ROWS, BufferUse::SHARED)) {}

const RowBuffer& BrdfCandidatesPass::record(const DirectFrame& direct) {
    const Program& program = programs_.compute("direct/brdf_rays", direct.defines);
    program.set("sample_index", direct.sample);
    PassRecorder pass = direct.frame.pass("direct/brdf_rays");
    read_gbuffer(pass, direct.gbuffer).write(0, rays_).dispatch(program, width_px_, height_px_);
    direct.frame.pass("direct/brdf_hits")
        .read_on_cpu(rays_.buffer())
        .write_on_cpu(hits_.buffer())
        .run_on_cpu([&] {
            result_ = direct.tracer.trace_closest_hits(
                rays_.buffer().mapped<glm::uvec4>(), hits_.buffer().mapped<glm::uvec4>(), direct.shadow_key);
        });
    return hits_;
}

}  // namespace tarn
