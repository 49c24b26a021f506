// Pixels in which the rasterizer and the rays see different triangles.
#pragma once

#include <cstdint>
#include <vector>

#include "rays/ray_tracer.h"
#include "renderer/renderer.h"

namespace tarn {

// Indices of the pixels in which the G-buffer's triangle and that of the reference's camera ray differ in
// any of a few frames: both look through the pixel's centre but round differently at edges, and a light's
// edge in one such pixel outweighs the error of the whole picture.
std::vector<std::uint32_t> find_silhouettes(Renderer& renderer, const RayTracer& tracer, FrameInput input);

}  // namespace tarn
