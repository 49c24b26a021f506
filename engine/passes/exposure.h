// The exposure of a frame: found from its radiance on the device, or fixed.
#pragma once

#include <optional>

#include "core/display.h"
#include "frame/history.h"
#include "passes/frame_context.h"

namespace tarn {

// One row: 2^EV, EV.
using Exposure = Rows;

// What the shown picture is exposed by.
struct ExposureInput {
    std::optional<float> fixed_ev;  // none: follows the pictures
    double elapsed_s = 1.0 / 60.0;  // since the last frame: how far an exposure that follows may go
    ToneCurve tone = ToneCurve::NEUTRAL;
};

// Automatic: the EV that auto_exposure_ev (core/display.h) finds; from `previous` it gets 63 % of the way
// there in EXPOSURE_TIME_S, in stops, so that it neither jumps nor flickers. Without `previous` it is there
// at once. The same pictures give the same bits.
Exposure find_exposure(const FrameContext& frame, const Picture& radiance, const ExposureInput& input,
                       const std::optional<Previous<Exposure>>& previous);

constexpr double EXPOSURE_TIME_S = 0.4;

}  // namespace tarn
