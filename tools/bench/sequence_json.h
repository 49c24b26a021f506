// Measures to and from JSON, field by field.
#pragma once

#include <nlohmann/json.hpp>

#include "bench/sequence.h"

namespace tarn {

NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(ImageErrors, mse, rmse, rel_mse, rel_mse_trimmed, rmspe, mape, mean_ratio,
                                   pixels, non_finite)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(PictureErrors, linear, flip_ldr)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(CurvePoint, frames, mse, rel_mse, rel_mse_trimmed)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(PassSamples, name, ms)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(SequenceMeasure, frame_ms, passes, rays, flicker, shared_samples,
                                   repeated_frames, first, mean, counters, curve)

}  // namespace tarn
