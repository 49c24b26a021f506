#include "passes/indirect/coarse.h"

#include "shared/interface/bindings.h"

namespace tarn {

glm::ivec2 coarse_size_px(const glm::ivec2& full_px, int step_px) {
    return (full_px + step_px - 1) / step_px;
}

glm::uvec2 pick_offset(std::uint32_t frame, int step_px) {
    glm::uvec2 offset(0u);
    for (std::uint32_t half = std::uint32_t(step_px) / 2u; half > 0u; half /= 2u) {
        const std::uint32_t quarter = frame % 4u;  // 0 0, 1 1, 1 0, 0 1
        offset += half * glm::uvec2((quarter + 1u) / 2u % 2u, quarter % 2u);
        frame /= 4u;
    }
    return offset;
}

FrameBlock make_coarse_block(FrameBlock full, int step_px) {
    const std::uint32_t frame = full.frame_size.z;
    const glm::ivec2 size_px = coarse_size_px(glm::ivec2(full.frame_full), step_px);
    full.frame_size = glm::uvec4(size_px, frame, full.frame_size.w);
    full.frame_full.z = std::uint32_t(step_px);
    full.frame_offset = glm::uvec4(pick_offset(frame, step_px), pick_offset(frame - 1u, step_px));
    return full;
}

void thin_surfaces(const FrameContext& coarse, const GBuffer& gbuffer, const SurfaceTable& target) {
    PassRecorder pass = coarse.pass("indirect/surfaces");
    read_gbuffer(pass, gbuffer).write_image(0, target.texels());
    pass.dispatch(coarse.compute(CoarseSurfacesVariant{}), coarse.size_px);
}

ReflectedLight upsample(const FrameContext& frame, const GBuffer& gbuffer,
                        const SurfaceTable& coarse_surfaces, const ReflectedLight& coarse_light) {
    const ReflectedLight light = take_reflected_light(frame, "indirect/upsample");
    PassRecorder pass = frame.pass("indirect/upsample");
    read_gbuffer(pass, gbuffer)
        .read(UNIT_PASS_A, coarse_light.diffuse)
        .read(UNIT_PASS_B, coarse_light.specular)
        .read(UNIT_PASS_C, coarse_surfaces.texels())
        .write_image(0, *light.diffuse)
        .write_image(1, *light.specular)
        .count(BLOCK_COUNTERS, frame.counters);
    pass.dispatch(frame.compute(UpsampleVariant{}), frame.size_px);
    return light;
}

}  // namespace tarn
