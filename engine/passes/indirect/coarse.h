// Indirect light on a coarse picture: its surfaces and camera rays, and its light brought to the picture's
// size.
//
// The coarse picture takes one pixel of each block of step x step pixels, another one each frame: over a
// cycle of frames every pixel has its turn.
#pragma once

#include "passes/gbuffer.h"
#include "passes/reflected_light.h"
#include "shared/interface/frame_block.h"

namespace tarn {

// Pixels of the coarse picture: one for each block, also for those that the picture's edge cuts.
glm::ivec2 coarse_size_px(const glm::ivec2& full_px, int step_px);

// Which pixel of its block the coarse picture of frame `frame` takes, each component in [0, step). Ordered as
// in Bayer's matrix: pixels of frames that follow each other lie far apart. `step_px`: a power of two.
glm::uvec2 pick_offset(std::uint32_t frame, int step_px);

// The frame block for passes over the coarse picture. `full`: that of the picture.
FrameBlock make_coarse_block(FrameBlock full, int step_px);

// Copies the surfaces of the pixels that the coarse picture takes into `target`. `coarse`: of the coarse
// picture's size, whose frame block is bound.
void thin_surfaces(const FrameContext& coarse, const GBuffer& gbuffer, const SurfaceTable& target);

// Light of the picture's surfaces `gbuffer` out of that of the coarse picture's (`coarse_surfaces`,
// `coarse_light`). Pixels that find no surface like theirs take the light of the nearest, and are counted.
// The coarse picture's frame block is bound.
ReflectedLight upsample(const FrameContext& frame, const GBuffer& gbuffer,
                        const SurfaceTable& coarse_surfaces, const ReflectedLight& coarse_light);

}  // namespace tarn
