#include "passes/denoise/denoise.h"

#include "shared/interface/bindings.h"
#include "shared/interface/constants/denoise.h"

namespace tarn {
namespace {

enum HistoryLayer { GUIDE, MOMENTS, DIFFUSE, SPECULAR, HISTORY_LAYER_COUNT };

// Two luminances are the same light where their squared difference is less than so many of their variances.
constexpr float LUMINANCE_FACTOR = 4.0f;

DenoiseConstants constants_for(const FrameContext& frame, int step) {
    const DenoiseSettings& settings = frame.settings.denoise;
    DenoiseConstants constants{};
    constants.history_frames = float(settings.history);
    constants.luminance_factor = LUMINANCE_FACTOR;
    constants.step_px = 1 << step;
    constants.is_diagonal = std::uint32_t(step % 2);
    return constants;
}

// Into pictures of its own, or into the history where that is the mean over time itself (then returns none).
ReflectedLight accumulate(const FrameContext& frame, const GBuffer& gbuffer, const NoisyLight& noisy,
                          const std::optional<Previous<KeptLight>>& previous, const DenoiseImages& images) {
    const DenoisePlan& plan = frame.plan.denoise;
    DenoiseConstants constants = constants_for(frame, 0);
    constants.has_previous = previous ? 1u : 0u;
    constants.has_changes = noisy.changes ? 1u : 0u;
    ReflectedLight light;
    if (plan.keeps_filtered) light = take_reflected_light(frame, "denoise/accumulate");
    PassRecorder pass = frame.pass("denoise/accumulate");
    read_gbuffer(pass, gbuffer)
        .constants(constants)
        .read(UNIT_PASS_A, noisy.direct.diffuse)
        .read(UNIT_PASS_B, noisy.direct.specular)
        .write_image(0, images.layers[GUIDE])
        .write_image(1, images.layers[MOMENTS])
        .count(BLOCK_COUNTERS, frame.counters);
    if (noisy.indirect)
        pass.read(UNIT_PASS_C, noisy.indirect.diffuse).read(UNIT_PASS_D, noisy.indirect.specular);
    if (previous) pass.read(UNIT_PREVIOUS_SURFACE, *previous, previous->value().images->stack);
    if (noisy.changes) pass.read(UNIT_PASS_E, noisy.changes);
    if (plan.keeps_filtered) {
        pass.write_image(2, *light.diffuse).write_image(3, *light.specular);
    } else {
        pass.write_image(2, images.layers[DIFFUSE]).write_image(3, images.layers[SPECULAR]);
    }
    pass.dispatch(frame.compute(plan.accumulate), frame.size_px);
    return light;
}

ReflectedLight filter(const FrameContext& frame, const GBuffer& gbuffer, const DenoiseImages& images,
                      int step, const Texture2D& diffuse, const Texture2D& specular) {
    const DenoisePlan& plan = frame.plan.denoise;
    const DenoiseFilterVariant variant = plan.filter(step == 0, step + 1 == plan.steps);
    const ReflectedLight light = take_reflected_light(frame, "denoise/filter");
    PassRecorder pass = frame.pass("denoise/filter");
    read_gbuffer(pass, gbuffer)
        .constants(constants_for(frame, step))
        .read(UNIT_PASS_A, images.layers[GUIDE])
        .read(UNIT_PASS_B, diffuse)
        .read(UNIT_PASS_C, specular)
        .write_image(0, *light.diffuse)
        .write_image(1, *light.specular)
        .count(BLOCK_COUNTERS, frame.counters);
    if (variant.is_first) pass.write_image(2, images.layers[DIFFUSE]).write_image(3, images.layers[SPECULAR]);
    pass.dispatch(frame.compute(variant), frame.size_px);
    return light;
}

}  // namespace

DenoiseImages::DenoiseImages(const glm::ivec2& size_px)
    : stack("denoise/history", size_px.x, size_px.y, HISTORY_LAYER_COUNT, GL_RGBA32F) {
    for (int layer = 0; layer < HISTORY_LAYER_COUNT; ++layer) {
        layers.emplace_back(fmt::format("denoise/history/{}", layer), stack, layer);
    }
}

DenoiseMeaning denoise_meaning(const FramePlan& plan) {
    return {plan.denoise.mode, plan.indirect.runs};
}

ReflectedLight Denoiser::record(const FrameContext& frame, const GBuffer& gbuffer, const NoisyLight& noisy,
                                const std::optional<Previous<KeptLight>>& previous, KeptLight& kept) {
    const DenoisePlan& plan = frame.plan.denoise;
    const auto images = images_.take(fmt::format("{} x {}", frame.size_px.x, frame.size_px.y),
                                     [&] { return DenoiseImages(frame.size_px); });
    ReflectedLight light = accumulate(frame, gbuffer, noisy, previous, *images);
    for (int step = 0; step < plan.steps; ++step) {
        const bool from_history = step == 0 && !plan.keeps_filtered;
        light = from_history
                    ? filter(frame, gbuffer, *images, step, images->layers[DIFFUSE], images->layers[SPECULAR])
                    : filter(frame, gbuffer, *images, step, *light.diffuse, *light.specular);
    }
    kept = {images, denoise_meaning(frame.plan)};
    return light;
}

}  // namespace tarn
