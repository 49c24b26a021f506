#include "passes/trace_rays.h"

#include "shared/math/random.h"

namespace tarn {

Picture trace_primary(const FrameContext& frame, const CameraRecord& camera) {
    Picture seen = frame.recorder.take_picture("gbuffer/seen", frame.size_px, GL_RG32UI);
    frame.pass("gbuffer/rays").write_on_cpu(*seen).run_on_cpu([&] {
        std::vector<glm::uvec2> answers(frame.pixel_count());
        frame.rays.camera += frame.tracer.trace_camera_rays({camera, frame.size_px, frame.jitter_px}, answers,
                                                            {frame.frame, frame.seed, RAY_CAMERA});
        seen->upload(answers);
    });
    return seen;
}

Answers trace_visibility(const FrameContext& frame, const std::string& name, const Rows& rays,
                         std::size_t ray_count, const CoverageKey& key) {
    Answers answers =
        frame.recorder.take_rows("visibility/answers", ray_count * sizeof(float), BufferUse::SHARED, GL_R32F);
    frame.pass(name).read_on_cpu(rays->buffer()).write_on_cpu(answers->buffer()).run_on_cpu([&] {
        const RayBatchResult result = frame.tracer.trace_visibility(
            rays->buffer().mapped<glm::uvec4>().first(ray_count * RAY_ROWS),
            answers->buffer().mapped<float>().first(ray_count), key, frame.previous.value_or(PreviousRays{}));
        frame.rays.shadow.traced += result.traced;
        frame.rays.shadow.rejected += result.rejected;
    });
    return answers;
}

Rows trace_closest_hits(const FrameContext& frame, const std::string& name, const Rows& rays,
                        std::size_t ray_count, const CoverageKey& key) {
    Rows hits = frame.recorder.take_rows(name, ray_count * HIT_ROWS * sizeof(glm::uvec4), BufferUse::SHARED);
    frame.pass(name).read_on_cpu(rays->buffer()).write_on_cpu(hits->buffer()).run_on_cpu([&] {
        const RayBatchResult result = frame.tracer.trace_closest_hits(
            rays->buffer().mapped<glm::uvec4>().first(ray_count * RAY_ROWS),
            hits->buffer().mapped<glm::uvec4>().first(ray_count * HIT_ROWS), key);
        frame.rays.closest += result.traced;
        frame.rays.shadow.rejected += result.rejected;
    });
    return hits;
}

}  // namespace tarn
