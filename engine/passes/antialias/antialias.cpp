#include "passes/antialias/antialias.h"

#include <algorithm>

#include "passes/exposure.h"
#include "shared/interface/bindings.h"
#include "shared/interface/constants/antialias.h"

namespace tarn {
namespace {

// Samples that the past counts as while things move: fewer follow changes sooner and show more noise.
constexpr double STEADY_COUNT = 10.0;
// A frame at a share of the size has fewer samples for a pixel: the past is to last as long, but long enough
// to hold one sample of each place.
constexpr double LEAST_STEADY_COUNT = 4.0;
constexpr float GREATEST_COUNT = 64.0f;

AntialiasConstants find_constants(const FrameContext& frame, const GBuffer& gbuffer,
                                  const AntialiasInput& input,
                                  const std::optional<Previous<KeptPicture>>& previous) {
    const double scale = frame.settings.antialias.scale;
    AntialiasConstants constants{};
    constants.steady_count = float(std::max(LEAST_STEADY_COUNT, STEADY_COUNT * scale * scale));
    constants.greatest_count = GREATEST_COUNT;
    constants.has_previous = previous ? 1u : 0u;
    constants.trusts_past = gbuffer.previous && (!frame.scene_changed || input.changes) ? 1u : 0u;
    constants.has_changes = input.changes ? 1u : 0u;
    constants.has_previous_motion = previous && previous->value().knows_motion ? 1u : 0u;
    return constants;
}

}  // namespace

KeptPicture antialias(const FrameContext& frame, const GBuffer& gbuffer, const AntialiasInput& input,
                      std::optional<Previous<KeptPicture>> previous) {
    const AntialiasVariant variant{!frame.has_moved, frame.output_px != frame.size_px,
                                   frame.settings.antialias.mean};
    KeptPicture kept;
    kept.settings = frame.settings;
    kept.settings.antialias.scale = 1.0;  // the picture has its size at every scale
    kept.knows_motion = frame.plan.features.motion;
    if (previous && previous->value().settings != kept.settings) previous.reset();

    const Exposure exposure = find_exposure(frame, input.radiance, {}, std::nullopt);
    kept.mean = kept.shown = frame.recorder.take_picture("antialias", frame.output_px, GL_RGBA32F);
    PassRecorder pass = frame.pass("antialias");
    read_gbuffer(pass, gbuffer)
        .constants(find_constants(frame, gbuffer, input, previous))
        .read(UNIT_PASS_A, input.radiance)
        .read(UNIT_PASS_C, exposure)
        .write_image(0, *kept.mean)
        .count(BLOCK_COUNTERS, frame.counters);
    if (variant.splits_excess()) {
        kept.shown = frame.recorder.take_picture("antialias/shown", frame.output_px, GL_RGBA32F);
        pass.write_image(1, *kept.shown);
        if (variant.at_rest && previous) pass.read(UNIT_PASS_E, *previous, previous->value().shown);
    }
    if (previous) pass.read(UNIT_PASS_B, *previous, previous->value().mean);
    if (input.changes) pass.read(UNIT_PASS_D, input.changes);
    if (gbuffer.previous) {
        pass.read(UNIT_PREVIOUS_SURFACE, *gbuffer.previous, gbuffer.previous->value()->texels());
    }
    pass.dispatch(frame.compute(variant), frame.output_px);
    return kept;
}

}  // namespace tarn
