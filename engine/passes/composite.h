// Joins the light of all stages to the radiance of the picture.
#pragma once

#include "passes/gbuffer.h"
#include "passes/reflected_light.h"

namespace tarn {

// RGBA32F, W sr^-1 m^-2: emission, and the light that surfaces reflect. What is not finite becomes black with
// w = 0 and is counted; else w is 1 + the share of the light that the surface emits. `indirect`: none where
// the plan has none.
Picture composite(const FrameContext& frame, const GBuffer& gbuffer, const ReflectedLight& direct,
                  const ReflectedLight& indirect);

}  // namespace tarn
