// Antialiasing over time, and enlarging with it. Shader: passes/antialias.comp.
#pragma once

#include <optional>

#include "frame/history.h"
#include "passes/gbuffer.h"

namespace tarn {

// The picture of the last frames, and by which settings it was made: one of others is no past, but for
// their scale.
struct KeptPicture {
    Picture picture;
    RenderSettings settings;
    bool knows_motion = false;  // whether its frame's surfaces know where they were before
};

struct AntialiasInput {
    Picture radiance;  // RGBA32F of the frame's size; w = 0: not to be used
    Picture changes;   // find_light_changes; none: not known
};

// `input` joined with the picture of the last frames, at the output's size; w: how many samples stand behind
// a pixel. `previous`: what the last frame kept.
Picture antialias(const FrameContext& frame, const GBuffer& gbuffer, const AntialiasInput& input,
                  const std::optional<Previous<KeptPicture>>& previous);

}  // namespace tarn
