#include "passes/denoise/denoise.h"

#include "shared/interface/bindings.h"
#include "shared/interface/constants/denoise.h"

namespace tarn {
namespace {

enum HistoryLayer { GUIDE, MOMENTS, DIFFUSE, SPECULAR, HISTORY_LAYER_COUNT };

// Two luminances are the same light where their squared difference is less than so many of their variances.
constexpr float LUMINANCE_FACTOR = 16.0f;

DenoiseConstants constants_for(const FrameContext& frame, int step) {
    const DenoiseSettings& settings = frame.settings.denoise;
    DenoiseConstants constants{};
    constants.history_frames = float(settings.history);
    constants.luminance_factor = LUMINANCE_FACTOR;
    constants.step_px = 1 << step;
    constants.is_diagonal = std::uint32_t(step % 2);
    return constants;
}

// Light without albedo as the filter reads and writes it, and the guide of its pixels.
struct LightViews {
    const Texture2D& diffuse;
    const Texture2D& specular;
};

// The history of the filter's mode is its first step's result, that of the bilateral one the mean over time.
ReflectedLight accumulate(const FrameContext& frame, const GBuffer& gbuffer, const NoisyLight& noisy,
                          const std::optional<Previous<KeptLight>>& previous, const DenoiseImages& images) {
    const DenoisePlan& plan = frame.plan.denoise;
    DenoiseConstants constants = constants_for(frame, 0);
    constants.has_previous = previous ? 1u : 0u;
    constants.has_changes = noisy.changes ? 1u : 0u;
    const ReflectedLight light = take_reflected_light(frame, "denoise/accumulate");
    PassRecorder pass = frame.pass("denoise/accumulate");
    read_gbuffer(pass, gbuffer)
        .constants(constants)
        .read(UNIT_PASS_A, noisy.direct.diffuse)
        .read(UNIT_PASS_B, noisy.direct.specular)
        .write_image(0, images.layers[GUIDE])
        .write_image(1, images.layers[MOMENTS])
        .count(BLOCK_COUNTERS, frame.counters);
    if (noisy.indirect) pass.read(UNIT_PASS_C, noisy.indirect.diffuse).read(UNIT_PASS_D, noisy.indirect.specular);
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

void filter(const FrameContext& frame, const GBuffer& gbuffer, const DenoiseImages& images, int step,
            const LightViews& from, const LightViews& to) {
    const DenoisePlan& plan = frame.plan.denoise;
    const bool is_first = step == 0, is_last = step + 1 == plan.steps;
    PassRecorder pass = frame.pass("denoise/filter");
    read_gbuffer(pass, gbuffer)
        .constants(constants_for(frame, step))
        .read(UNIT_PASS_A, images.layers[GUIDE])
        .read(UNIT_PASS_B, from.diffuse)
        .read(UNIT_PASS_C, from.specular)
        .write_image(0, to.diffuse)
        .write_image(1, to.specular)
        .count(BLOCK_COUNTERS, frame.counters);
    if (is_first && is_last && plan.keeps_filtered)
        pass.write_image(2, images.layers[DIFFUSE]).write_image(3, images.layers[SPECULAR]);
    pass.dispatch(frame.compute(plan.filter(is_first, is_last)), frame.size_px);
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
    const LightViews history{images->layers[DIFFUSE], images->layers[SPECULAR]};
    const ReflectedLight accumulated = accumulate(frame, gbuffer, noisy, previous, *images);
    ReflectedLight light = accumulated, result;
    for (int step = 0; step < plan.steps; ++step) {
        const bool from_history = plan.keeps_filtered ? step == 1 : step == 0;
        const bool to_history = plan.keeps_filtered && step == 0 && plan.steps > 1;
        result = to_history ? light : take_reflected_light(frame, "denoise/filter");
        const LightViews own{*light.diffuse, *light.specular}, next{*result.diffuse, *result.specular};
        filter(frame, gbuffer, *images, step, from_history ? history : own, to_history ? history : next);
        light = result;
    }
    kept = {images, denoise_meaning(frame.plan)};
    return light;
}

}  // namespace tarn
