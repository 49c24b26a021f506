#include "passes/indirect/shade.h"

#include "shared/interface/bindings.h"
#include "shared/interface/constants/shade.h"

namespace tarn {
namespace {

ShadeConstants constants_for(const FrameContext& frame, const SampleSlot& slot) {
    const DebugView view = frame.plan.indirect.view;
    const int path_view = view == DebugView::NONE ? 0 : int(view) - int(DebugView::PATH_DIRECTION);
    return {slot.target_weights, 1.0f, std::uint32_t(path_view)};
}

IndirectShadeVariant variant_for(const FrameContext& frame, const ShadeInput& input, bool adds) {
    if (frame.plan.indirect.view != DebugView::NONE) return {ShadeSource::RESERVOIR, true};
    return {source_of(input), false, frame.plan.indirect.targets.size() > 1, adds};
}

}  // namespace

ReflectedLight shade_indirect(const FrameContext& frame, const GBuffer& gbuffer, const SampleSlot& slot,
                              const ShadeInput& input, const ReflectedLight& earlier) {
    const ReflectedLight light = earlier ? earlier : take_reflected_light(frame, "indirect/light");
    PassRecorder pass = frame.pass("indirect/shade");
    read_gbuffer(pass, gbuffer).constants(constants_for(frame, slot));
    read_shade_input(pass, input);
    write_light(pass, light, bool(earlier));
    pass.dispatch(frame.compute(variant_for(frame, input, bool(earlier))), frame.size_px);
    return light;
}

}  // namespace tarn
