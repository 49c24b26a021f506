#include "passes/visibility.h"

namespace tarn {

VisibilityPass::VisibilityPass(std::size_t ray_capacity)
    : answers_("visibility/answers", ray_capacity * sizeof(float), BufferUse::SHARED, GL_R32F) {}

const RowBuffer& VisibilityPass::record(FrameRecorder& frame, const std::string& name,
                                        const RayTracer& tracer, const Buffer& rays, std::size_t ray_count,
                                        const CoverageKey& key, const PreviousRays& previous) {
    frame.pass(name).read_on_cpu(rays).write_on_cpu(answers_.buffer()).run_on_cpu([&] {
        const auto ray_rows = rays.mapped<glm::uvec4>().first(ray_count * RAY_ROWS);
        result_ = tracer.trace_visibility(ray_rows, answers_.buffer().mapped<float>().first(ray_count), key,
                                          previous);
    });
    return answers_;
}

}  // namespace tarn
