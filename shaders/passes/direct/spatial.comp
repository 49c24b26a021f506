// Direct light, reuse over space: lib/reuse/spatial.glsl with light samples.
#include "shared/interface/constants/reuse.h"
#include "lib/scene_buffers.glsl"
#include "lib/frame.glsl"
#include "lib/gbuffer.glsl"
#include "lib/counters.glsl"
#include "lib/receiver.glsl"
#include "lib/neighbour_test.glsl"
#include "lib/direct/light_samples.glsl"
#include "lib/pixel_group.glsl"

#include "lib/reuse/spatial.glsl"
