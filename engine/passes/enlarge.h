// A frame that is drawn smaller than it is shown.
#pragma once

#include "passes/frame_context.h"

namespace tarn {

// `picture` (RGBA32F) at the frame's output size, by bilinear interpolation; itself where it has that size.
Picture enlarge(const FrameContext& frame, const Picture& picture);

}  // namespace tarn
