#include "passes/visibility.h"

namespace tarn {

VisibilityPass::VisibilityPass(std::size_t ray_count)
    : ray_count_(ray_count),
      answers_("visibility/answers", ray_count * sizeof(float), BufferUse::SHARED),
      texture_("visibility/answers", answers_, GL_R32F) {}

Visibility VisibilityPass::record(FrameRecorder& frame, const RayTracer& tracer, const Buffer& rays,
                                  const CoverageKey& key) {
    frame.pass("visibility").write_on_cpu(answers_).run_on_cpu([&] {
        const auto ray_rows = rays.mapped<glm::uvec4>().first(ray_count_ * RAY_ROWS);
        result_ = tracer.trace_visibility(ray_rows, answers_.mapped<float>().first(ray_count_), key);
    });
    return {answers_, texture_};
}

}  // namespace tarn
