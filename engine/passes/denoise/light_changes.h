// How much of the direct light of a place is new: what the denoiser shortens its history by.
#pragma once

#include <optional>

#include "passes/gbuffer.h"
#include "passes/reuse/samples.h"

namespace tarn {

// R32F, a texel for each cell of CHANGE_CELL x CHANGE_CELL pixels: the share of the light there that has
// changed since the last frame, 0 to 1. Compares light samples of both frames (`previous`, `present`) in both
// frames, with rays where things move.
Picture find_light_changes(const FrameContext& frame, const GBuffer& gbuffer,
                           const Previous<KeptSamples>& previous, const KeptSamples& present);

}  // namespace tarn
