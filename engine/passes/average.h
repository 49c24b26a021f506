// The mean of frames that show the same: it converges while camera and world rest.
#pragma once

#include <cstdint>
#include <optional>

#include "frame/history.h"
#include "passes/frame_context.h"

namespace tarn {

struct AveragedFrames {
    Picture mean;  // RGBA32F; alpha: shared/math/average.h
    std::uint32_t frames = 0;
    std::optional<Picture> before;  // what was shown before the first of them
};

struct AveragedPicture {
    AveragedFrames averaged;
    Picture shown;  // the mean; while frames are few, the picture before them shines through
    Rows sums;      // for find_relative_error; none for a single frame
};

// Adds `radiance` to what the last frame kept; without that it is the first one, and `before` the picture
// that the last frame showed, if there is one.
AveragedPicture average_frames(const FrameContext& frame, const Picture& radiance,
                               const std::optional<Previous<AveragedFrames>>& previous,
                               const std::optional<Previous<Picture>>& before);

// The error that is left in the mean: the root of the mean variance of its pixels' luminance, relative to
// their mean luminance. 0 for no sums. Waits for the device.
double find_relative_error(const Rows& sums);

}  // namespace tarn
