// Antialiasing over time, and enlarging with it. Shader: passes/antialias.comp.
#pragma once

#include <optional>

#include "frame/history.h"
#include "passes/gbuffer.h"

namespace tarn {

// The pictures of the last frames, and by which settings they were made: those of others are no past, but for
// their scale.
struct KeptPicture {
    Picture mean;   // what the next frame joins; w: how many samples stand behind a pixel
    Picture shown;  // with what lamps emit beyond white; w: how many samples stand behind that; or the same
    RenderSettings settings;
    bool knows_motion = false;  // whether its frame's surfaces know where they were before
};

struct AntialiasInput {
    Picture radiance;  // what composite() found
    Picture changes;   // find_light_changes; none: not known
};

// `input` joined with the picture of the last frames, at the output's size, and what the next frame needs of
// it. `previous`: what the last frame kept.
KeptPicture antialias(const FrameContext& frame, const GBuffer& gbuffer, const AntialiasInput& input,
                      std::optional<Previous<KeptPicture>> previous);

}  // namespace tarn
